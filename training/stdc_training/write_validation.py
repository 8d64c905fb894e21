"""Write the validation sets as pictures: python3 -m stdc_training.write_validation DATA OUTPUT.

OUTPUT/SET/image/*.png and OUTPUT/SET/label/*.png (0 background, 1 person, 255 ignore), to be
scored by the program itself: stdc-slam segment OUTPUT/SET/image --output MASKS --score
OUTPUT/SET/label --truth labels. The pictures are photos of others: not for publication.
"""

import argparse
from pathlib import Path

import cv2

from . import people
from .score import validation_sets


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", help="folder of the packed validation set")
    parser.add_argument("output")
    parser.add_argument("--size", type=int, nargs=2, default=(512, 384), metavar=("W", "H"))
    options = parser.parse_args()
    packed = people.Packed(options.data, "validation")
    for name, pairs in validation_sets(packed, tuple(options.size)).items():
        folder = Path(options.output) / name.replace(" ", "_")
        for part in ("image", "label"):
            (folder / part).mkdir(parents=True, exist_ok=True)
        for i, (image, label) in enumerate(pairs):
            cv2.imwrite(str(folder / "image" / f"{i:03}.png"), cv2.cvtColor(image, cv2.COLOR_RGB2BGR))
            cv2.imwrite(str(folder / "label" / f"{i:03}.png"), label)
        print(f"{folder}: {len(pairs)} pictures")


if __name__ == "__main__":
    main()
