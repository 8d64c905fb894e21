"""The validation sets: fixed lists of (image, label) at one size, made from held-out data only."""

import cv2
import numpy as np

from . import people
from .compose import compose
from .samples import CUTOUT_SHARES, LEAST_CUTOUT_HEIGHT
from .views import affine, warp

GREY = 114


def fitted(packed, size):
    """A packed image fitted into (width, height), its shape kept, the rest grey and ignored."""
    height, width = packed.shape[:2]
    scale = min(size[0] / width, size[1] / height)
    inner = (max(1, round(width * scale)), max(1, round(height * scale)))
    mode = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    x, y = (size[0] - inner[0]) // 2, (size[1] - inner[1]) // 2
    image = np.full((size[1], size[0], 3), GREY, np.uint8)
    label = np.full((size[1], size[0]), 255, np.uint8)
    area = (slice(y, y + inner[1]), slice(x, x + inner[0]))
    image[area] = cv2.resize(np.ascontiguousarray(packed[..., :3]), inner, interpolation=mode)
    label[area] = cv2.resize(np.ascontiguousarray(packed[..., 3]), inner,
                             interpolation=cv2.INTER_NEAREST)
    return image, label


def photos(packed, kinds, size, every=1):
    """Held-out photos that show people, fitted into the size."""
    chosen = [i for i, entry in enumerate(packed.index) if entry["kind"] in kinds and entry["box"]]
    return [fitted(packed[i], size) for i in chosen[::every]]


def without_people(packed, size, scenes, every=1):
    """Held-out pictures that show nobody: rooms (`scenes`) or other places."""
    chosen = [i for i, entry in enumerate(packed.index)
              if entry["box"] is None and (entry["kind"] == people.EMPTY) == scenes]
    return [fitted(packed[i], size) for i in chosen[::every]]


def close_ups(packed, size, count, seed=12):
    """Crops of held-out photos with own masks in which a person is cut by the frame and fills
    more than a third of it."""
    rng = np.random.default_rng(seed)
    chosen = [i for i, entry in enumerate(packed.index)
              if entry["box"] and entry["kind"] in ("ccp_masked", "human291_masked")]
    found = []
    while len(found) < count:
        i = int(rng.choice(chosen))
        x0, y0, x1, y1 = packed.index[i]["box"]
        height, width = packed.index[i]["shape"]
        limit = min(height, width * size[1] / size[0])
        source_height = limit * rng.uniform(0.5, 1.0)
        half = source_height / 2, source_height / 2 * size[0] / size[1]
        centre = (np.clip(rng.uniform(x0, x1), half[1], width - half[1]),
                  np.clip(rng.uniform(y0, y1), half[0], height - half[0]))
        image, label = warp(packed[i], affine(centre, source_height, size), size)
        if (label == 1).mean() > 1 / 3:
            found.append((image, label))
    return found


def composed(packed, size, count, seed=11):
    """People of held-out photos on frames of held-out rooms, one to three at a time."""
    rng = np.random.default_rng(seed)
    rooms = [i for i, entry in enumerate(packed.index) if entry["kind"] == people.EMPTY]
    cutouts = [i for i, entry in enumerate(packed.index)
               if entry["box"] and entry["kind"] in CUTOUT_SHARES
               and entry["box"][3] - entry["box"][1] >= LEAST_CUTOUT_HEIGHT * entry["shape"][0]]
    found = []
    while len(found) < count:
        frame, _ = fitted(packed[int(rng.choice(rooms))], size)
        picks = [int(i) for i in rng.choice(cutouts, rng.choice([1, 2, 3], p=[0.6, 0.28, 0.12]))]
        image, label = compose(rng, frame, [(packed.index[i], packed[i]) for i in picks], size)
        if (label == 1).mean() > 0.01:
            found.append((image, label))
    return found


def turned(pairs, seed=13):
    """The same pictures as a camera sees them that is turned about its axis by 15 to 40 degrees,
    scaled so that little of their surroundings, mirrored in, is seen."""
    rng = np.random.default_rng(seed)
    found = []
    for image, label in pairs:
        height, width = label.shape
        angle = np.deg2rad(rng.uniform(15, 40)) * rng.choice([-1, 1])
        view = affine((width / 2, height / 2), 0.8 * height, (width, height), angle)
        found.append(warp(np.dstack([image, label]), view, (width, height)))
    return found
