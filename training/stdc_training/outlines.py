"""Labels from outlines drawn by hand: python3 -m stdc_training.outlines SEQUENCES OUTPUT.

The outlines are those of kinect.txt; SEQUENCES holds the TUM sequences it names (whole or their
first part). Writes OUTPUT/people and OUTPUT/nobody, each with image/*.png and label/*.png, for
stdc-slam segment OUTPUT/people/image --output MASKS --score OUTPUT/people/label --truth labels.
"""

import argparse
from pathlib import Path

import cv2
import numpy as np

OUTLINES = Path(__file__).resolve().parent.parent / "kinect.txt"


def read(path=OUTLINES):
    """List of (sequence, time, corners [n, 2] or None) of the file."""
    found = []
    for line in Path(path).read_text().splitlines():
        if not line or line.startswith("#"):
            continue
        sequence, time, *corners = line.split()
        points = [] if corners == ["-"] else [[int(v) for v in c.split(",")] for c in corners]
        found.append((sequence, time, np.array(points) if points else None))
    return found


def label(corners, shape):
    """uint8 label [h, w]: 1 inside the outline."""
    found = np.zeros(shape, np.uint8)
    if corners is not None:
        cv2.fillPoly(found, [corners.astype(np.int32)], 1)
    return found


def picture_of(root, sequence, time):
    """The colour image of a time in the sequence whose folder's name holds `sequence`."""
    for path in sorted(Path(root).glob(f"*{sequence}*/rgb/{time}.*")):
        image = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if image is not None:
            return image
    raise FileNotFoundError(f"{root}: no readable *{sequence}*/rgb/{time}.png or .jpg; "
                            "give the folder that holds the TUM sequences")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sequences")
    parser.add_argument("output")
    options = parser.parse_args()
    for sequence, time, corners in read():
        image = picture_of(options.sequences, sequence, time)
        folder = Path(options.output) / ("nobody" if corners is None else "people")
        for part, data in (("image", image), ("label", label(corners, image.shape[:2]))):
            (folder / part).mkdir(parents=True, exist_ok=True)
            cv2.imwrite(str(folder / part / f"{sequence}_{time}.png"), data)


if __name__ == "__main__":
    main()
