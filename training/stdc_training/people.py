"""The photos with person labels: listing, split into training and validation, packing.

Packed data are one flat uint8 file per set that is memory-mapped, so that a training step
neither decodes nor copies more than it uses. Each image is [h, w, 4]: RGB and the label
(0 background, 1 person, or more classes in the order of `export --classes`; 255 ignore);
person-free frames have label 0.
"""

import json
import os
from pathlib import Path

import cv2
import numpy as np

KINDS = ("ccp_masked", "ccp_teacher", "lspet_teacher", "voc_teacher", "human291_masked")
EMPTY = "empty_indoor"
# Whole scenes are held out: neighbouring frames of one scene are nearly the same picture.
VALIDATION_SCENES = ("realsense", "iclnuim")
VALIDATION_SHARE = 0.1
VALIDATION_LIST = Path(__file__).resolve().parent.parent / "validation.txt"


def list_images(root):
    """All images as (kind, name without ending), sorted."""
    found = []
    for kind in (*KINDS, EMPTY):
        folder = Path(root) / kind / "image"
        names = sorted(path.stem for path in folder.glob("*.jpg"))
        if not names:
            raise FileNotFoundError(f"{folder}: no *.jpg here; give the folder of the people data")
        found += [(kind, name) for name in names]
    return found


def choose_validation(root, seed=4):
    """A tenth of each kind, half of it empty where a kind has empty images, and whole scenes."""
    rng = np.random.default_rng(seed)
    chosen = []
    for kind in KINDS:
        groups = {True: [], False: []}
        for path in sorted((Path(root) / kind / "label").glob("*.png")):
            label = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
            groups[bool((label == 1).any())].append((kind, path.stem))
        for group in groups.values():
            picks = rng.permutation(len(group))[: round(VALIDATION_SHARE * len(group))]
            chosen += [group[i] for i in sorted(picks)]
    chosen += [item for item in list_images(root)
               if item[0] == EMPTY and item[1].startswith(VALIDATION_SCENES)]
    return chosen


def read_validation(path=VALIDATION_LIST):
    """The fixed validation images as a set of (kind, name)."""
    lines = Path(path).read_text().split("\n")
    return {tuple(line.split("/")) for line in lines if line and not line.startswith("#")}


def load(root, kind, name):
    """One image as [h, w, 4] uint8: RGB and label."""
    path = Path(root) / kind / "image" / f"{name}.jpg"
    image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    if image is None:
        raise FileNotFoundError(f"{path}: cannot be read as an image")
    image = cv2.cvtColor(image, cv2.COLOR_BGR2RGB)
    label = np.zeros(image.shape[:2], np.uint8)
    if kind != EMPTY:
        path = Path(root) / kind / "label" / f"{name}.png"
        label = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
        if label is None or label.shape != image.shape[:2]:
            raise ValueError(f"{path}: no label of the image's size")
    return np.dstack([image, label])


def shrink(image, long_side):
    """Scale [h, w, 4] so that the longer side is at most `long_side` pixels."""
    height, width = image.shape[:2]
    scale = long_side / max(height, width)
    if scale >= 1:
        return image
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    colour = cv2.resize(image[..., :3], size, interpolation=cv2.INTER_AREA)
    return np.dstack([colour, cv2.resize(image[..., 3], size, interpolation=cv2.INTER_NEAREST)])


def person_box(label):
    """(x0, y0, x1, y1) around the person pixels, ends excluded; None without any."""
    rows, columns = (np.flatnonzero((label == 1).any(axis)) for axis in (1, 0))
    if rows.size == 0:
        return None
    return [int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1]


def pack(root, folder, items, name, long_side):
    """Write `name`.bin and `name`.json with the given (kind, name) items into `folder`."""
    os.makedirs(folder, exist_ok=True)
    index, offset = [], 0
    with open(Path(folder) / f"{name}.bin", "wb") as file:
        for kind, stem in items:
            image = shrink(load(root, kind, stem), long_side)
            file.write(image.tobytes())
            index.append({"kind": kind, "name": stem, "offset": offset,
                          "shape": list(image.shape[:2]), "box": person_box(image[..., 3])})
            offset += image.nbytes
    (Path(folder) / f"{name}.json").write_text(json.dumps(index))


class Packed:
    """Random access to a packed set; `index` holds kind, name, shape and person box."""

    def __init__(self, folder, name):
        self.index = json.loads((Path(folder) / f"{name}.json").read_text())
        self._data = np.memmap(Path(folder) / f"{name}.bin", np.uint8, "r")

    def __len__(self):
        return len(self.index)

    def __getitem__(self, i):
        entry = self.index[i]
        height, width = entry["shape"]
        begin = entry["offset"]
        return self._data[begin:begin + height * width * 4].reshape(height, width, 4)
