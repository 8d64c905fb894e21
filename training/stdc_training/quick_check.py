"""Scores on small validation subsets: cheap enough to be taken in the course of a training."""

import numpy as np

from . import evaluation_sets, people
from .predict import intersection_over_union, overlap, person_maps


def validation_subset(folder, size):
    """Small sets by name, enough to see where a training goes; at the size of the training."""
    packed = people.Packed(folder, "validation")
    return {
        "photos": evaluation_sets.photos(packed, ("ccp_masked", "human291_masked"), size, 3),
        "hard": evaluation_sets.photos(packed, ("lspet_teacher", "voc_teacher"), size, 4),
        "composed": evaluation_sets.composed(packed, size, 40),
        "empty": evaluation_sets.without_people(packed, size, True, 3),
    }


def quick_scores(network, sets):
    """Mean IoU by set; for "empty" the share of pixels wrongly called person."""
    scores = {}
    for name, pairs in sets.items():
        maps = person_maps(network, [image for image, _ in pairs])
        counts = [overlap(found, label) for found, (_, label) in zip(maps, pairs)]
        if name == "empty":
            scores[name] = float(np.mean([found.mean() for found in maps]))
        else:
            scores[name] = float(np.mean([intersection_over_union(c) for c in counts]))
    scores["total"] = (scores["photos"] + scores["hard"] + scores["composed"]) / 3 - scores["empty"]
    return scores
