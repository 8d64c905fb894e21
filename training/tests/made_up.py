"""A made-up data set in the layout of the real one: blobs on noise."""

from pathlib import Path

import cv2
import numpy as np

from stdc_training import people

SHAPE = (60, 80)


def write_people(root, per_kind=12):
    """Write `per_kind` pictures of every kind; every other voc picture shows nobody."""
    rng = np.random.default_rng(3)
    for kind in (*people.KINDS, people.EMPTY):
        for part in ("image", "label"):
            (Path(root) / kind / part).mkdir(parents=True, exist_ok=True)
        for i in range(per_kind):
            image = rng.integers(0, 120, (*SHAPE, 3), dtype=np.uint8)
            label = np.zeros(SHAPE, np.uint8)
            if kind != people.EMPTY and not (kind == "voc_teacher" and i % 2):
                centre = (int(rng.integers(25, 55)), 32)
                cv2.ellipse(label, centre, (10, 24), 0, 0, 360, 1, -1)
                image[label == 1] = (60, 120, 250)
            scene = ("kitchen", "hololens", "realsense", "iclnuim")[i % 4]
            name = f"{scene}_{i}" if kind == people.EMPTY else f"p{i}"
            cv2.imwrite(str(Path(root) / kind / "image" / f"{name}.jpg"), image)
            if kind != people.EMPTY:
                cv2.imwrite(str(Path(root) / kind / "label" / f"{name}.png"), label)


def write_packed(root, folder):
    """Pack a made-up data set with its own validation list."""
    write_people(root)
    held_out = set(people.choose_validation(root))
    items = people.list_images(root)
    people.pack(root, folder, [i for i in items if i not in held_out], "train", 80)
    people.pack(root, folder, [i for i in items if i in held_out], "validation", 80)
