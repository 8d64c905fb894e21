"""Pack frames of the project's renderer: python3 -m stdc_training.pack_rendered FOLDER SEQUENCE...

Each SEQUENCE is a folder of `stdc-slam render` (rgb/, mask/ with 255 = moving). The result is
the set "rendered" in FOLDER. Render with seeds that no test uses: the test's people and
textures must not have been trained on.
"""

import argparse
import json
from pathlib import Path

import cv2
import numpy as np

from .people import person_box, shrink


def load(path):
    """One rendered frame as [h, w, 4] uint8: RGB and label."""
    image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    mask = cv2.imread(str(path.parent.parent / "mask" / path.name), cv2.IMREAD_GRAYSCALE)
    if image is None or mask is None:
        raise FileNotFoundError(f"{path}: no picture or no mask of that name")
    return np.dstack([cv2.cvtColor(image, cv2.COLOR_BGR2RGB), (mask > 127).astype(np.uint8)])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("sequences", nargs="+")
    parser.add_argument("--every", type=int, default=3, help="neighbouring frames are alike")
    parser.add_argument("--long-side", type=int, default=320)
    options = parser.parse_args()
    index, offset = [], 0
    with open(Path(options.folder) / "rendered.bin", "wb") as file:
        for sequence in options.sequences:
            for path in sorted((Path(sequence) / "rgb").glob("*.png"))[::options.every]:
                image = shrink(load(path), options.long_side)
                file.write(image.tobytes())
                index.append({"kind": "rendered", "name": f"{Path(sequence).name}/{path.stem}",
                              "offset": offset, "shape": list(image.shape[:2]),
                              "box": person_box(image[..., 3])})
                offset += image.nbytes
    (Path(options.folder) / "rendered.json").write_text(json.dumps(index))
    print(f"{len(index)} frames")


if __name__ == "__main__":
    main()
