"""pattern_sequence.py FOLDER FRAMES: a tiny sequence in TUM layout whose every pixel follows a formula, for tests that
compare what they read from recordings of it: src/input/recordings/messages/test_pattern.hpp has the same formula."""
import pathlib
import sys

import numpy
from PIL import Image

WIDTH, HEIGHT, START = 64, 64, 1_700_000_000


def main():
    folder, frames = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    for name in ("rgb", "depth"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    x, y = numpy.meshgrid(numpy.arange(WIDTH), numpy.arange(HEIGHT))
    rgb = depth = truth = ""
    for i in range(frames):
        colour = numpy.stack([16 * (x // 8) + i, 20 * (y // 8) + 2 * i, 40 * ((x // 8 + y // 8) % 2) + i], axis=-1)
        millimetres = numpy.where((x < 4) & (y < 4), 0, 1000 + 10 * (x // 8) + y // 8 + 100 * i)
        Image.fromarray(colour.astype(numpy.uint8)).save(folder / f"rgb/{i}.png")
        Image.fromarray(millimetres.astype(numpy.uint16)).save(folder / f"depth/{i}.png")
        micros = i * 1_000_000 // 30
        rgb += f"{START}.{micros:06} rgb/{i}.png\n"
        depth += f"{START}.{micros + 3000:06} depth/{i}.png\n"
        truth += f"{START}.{micros:06} {0.01 * i:.6f} 0 0 0 0 0 1\n"
    (folder / "rgb.txt").write_text(rgb)
    (folder / "depth.txt").write_text(depth)
    (folder / "groundtruth.txt").write_text(truth)
    (folder / "camera.yaml").write_text(f"width: {WIDTH}\nheight: {HEIGHT}\nfx: 60\nfy: 61\ncx: 31.5\ncy: 23.5\n"
                                        "k1: 0.1\nk2: -0.05\np1: 0.001\np2: 0.002\nk3: 0.01\ndepth_units_per_metre: 1000\n")


main()
