"""Calibrate a weights file's probabilities: python3 -m stdc_training.fit_probability MASKS LABELS [FILE].

MASKS holds what `stdc-slam segment IMAGES --probabilities` wrote with that file, LABELS the true
labels (NAME.png: 0 static, 1 dynamic, 255 ignore). Finds scale and offset of the log-odds (Platt,
1999) by Newton's method on every other image and says the expected calibration error (ECE, 15
bins of equal width; Naeini et al., 2015) on the rest, before and after. Given FILE, its entry
"probability" is set; what the masks were made with is taken into account. Needs numpy and cv2.
"""

import argparse
import json
from pathlib import Path

import cv2
import numpy as np

from . import safetensors, seal

BINS = 15
EVERY = 7  # pixels: neighbours are alike


def load(masks, labels):
    """[(log-odds, label)] of each image that has both."""
    pairs = []
    for path in sorted(Path(labels).glob("*.png")):
        found = cv2.imread(str(Path(masks) / f"{path.stem}-probability.png"), cv2.IMREAD_UNCHANGED)
        label = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
        if found is None or found.shape != label.shape:
            continue
        known = np.flatnonzero(label.ravel() != 255)[::EVERY]
        share = np.clip(found.ravel()[known].astype(np.float64), 0.5, 65534.5) / 65535
        pairs.append((np.log(share / (1 - share)), (label.ravel()[known] == 1).astype(np.float64)))
    if len(pairs) < 2:
        raise SystemExit(f"{masks}: has the probabilities of fewer than two images of {labels}")
    return pairs


def joined(pairs):
    return tuple(np.concatenate(parts) for parts in zip(*pairs))


def probability(odds, scale, offset):
    return 1 / (1 + np.exp(-(scale * odds + offset)))


def fit(odds, truth, rounds=30):
    """(scale, offset) that make the labels likeliest."""
    design = np.stack([odds, np.ones_like(odds)], 1)
    found = np.array([1.0, 0.0])
    for _ in range(rounds):
        expected = probability(odds, *found)
        hessian = design.T @ (design * (expected * (1 - expected))[:, None]) + 1e-9 * np.eye(2)
        step = np.linalg.solve(hessian, design.T @ (expected - truth))
        found -= np.clip(step, -0.5, 0.5)
    return tuple(float(value) for value in found)


def calibration_error(expected, truth):
    """Mean distance of probability and frequency, weighted by the pixels of each bin."""
    bins = np.minimum((expected * BINS).astype(int), BINS - 1)
    gap = np.bincount(bins, expected - truth, BINS)
    return float(np.abs(gap).sum() / len(truth))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("masks")
    parser.add_argument("labels")
    parser.add_argument("file", nargs="?", help="weights file that gets the result")
    options = parser.parse_args()
    pairs = load(options.masks, options.labels)
    scale, offset = fit(*joined(pairs[::2]))
    odds, truth = joined(pairs[1::2])
    for title, expected in (("before", probability(odds, 1, 0)),
                            ("after", probability(odds, scale, offset))):
        print(f"{title:<7} ECE {100 * calibration_error(expected, truth):.2f} %, "
              f"Brier {np.mean((expected - truth) ** 2):.4f}")
    if options.file:
        before = json.loads(safetensors.read(options.file)[1].get("probability", "[1, 0]"))
        entry = [round(scale * before[0], 5), round(scale * before[1] + offset, 5)]
        seal.seal(options.file, [("probability", json.dumps(entry))])
        print(f"{options.file}: scale {entry[0]}, offset {entry[1]}")
    else:
        print(f"scale {scale:.5f}, offset {offset:.5f}")


if __name__ == "__main__":
    main()
