"""Scores of a person map against its label: IoU, precision, recall, boundary F."""

import cv2
import numpy as np

from .predict import intersection_over_union, overlap

# Boundaries may lie apart by this share of the picture's diagonal (F. Perazzi et al., "A
# Benchmark Dataset and Evaluation Methodology for Video Object Segmentation", CVPR 2016).
BOUNDARY_SHARE = 0.008


def boundary(mask):
    """Pixels of the mask that have a neighbour outside it; the picture's rim is no boundary."""
    mask = mask.astype(np.uint8)
    inner = cv2.erode(mask, np.ones((3, 3), np.uint8), borderType=cv2.BORDER_REPLICATE)
    return (mask - inner).astype(bool)


def boundary_f(found, label):
    """F measure of the boundary pixels that have a counterpart nearby; 1 if both have none.

    Pixels labelled 255 belong to nobody: boundaries within reach of them do not count.
    """
    person = label == 1
    reach = int(np.ceil(BOUNDARY_SHARE * np.hypot(*label.shape)))
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1,) * 2)
    unsure = cv2.dilate((label == 255).astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    mine, true = boundary(found) & ~unsure, boundary(person) & ~unsure
    if not mine.any() and not true.any():
        return 1.0
    near_mine = cv2.dilate(mine.astype(np.uint8), disc).astype(bool)
    near_true = cv2.dilate(true.astype(np.uint8), disc).astype(bool)
    precision = (mine & near_true).sum() / max(mine.sum(), 1)
    recall = (true & near_mine).sum() / max(true.sum(), 1)
    return float(2 * precision * recall / max(precision + recall, 1e-12))


def scores(found, label):
    """IoU, precision, recall and boundary F of one picture, as a dict."""
    right, wrong, missed = counts = overlap(found, label)
    return {
        "iou": float(intersection_over_union(counts)),
        "precision": float(right / (right + wrong)) if right + wrong else 1.0,
        "recall": float(right / (right + missed)) if right + missed else 1.0,
        "boundary_f": boundary_f(found, label),
        "wrong_share": float(wrong / max((label != 255).sum(), 1)),
    }


def mean_scores(maps, labels):
    """Means of `scores` over pictures."""
    rows = [scores(found, label) for found, label in zip(maps, labels)]
    return {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}
