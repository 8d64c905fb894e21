"""Running a network over images, and counts of right and wrong pixels."""

import numpy as np
import torch

from .network import upsampled
from .weights import normalised


def person_maps(network, images, batch=8):
    """Boolean person maps [h, w] of uint8 RGB images of one size, at that size."""
    device = next(network.parameters()).device
    maps = []
    with torch.no_grad():
        for begin in range(0, len(images), batch):
            pixels = torch.from_numpy(np.stack(images[begin:begin + batch])).to(device)
            logits = upsampled(network(normalised(pixels)).float(), pixels.shape[1:3])
            maps += list((logits[:, 1:].max(1).values > logits[:, 0]).cpu().numpy())
    return maps


def overlap(found, label):
    """(right, wrongly person, missed) pixel counts; pixels labelled 255 do not count."""
    known, person = label != 255, label == 1
    return np.array([(found & person).sum(), (found & known & ~person).sum(),
                     (~found & person).sum()], np.int64)


def intersection_over_union(counts):
    """IoU of counts as given by overlap; 1 where there is nobody and nobody was found."""
    right, wrong, missed = counts
    total = right + wrong + missed
    return 1.0 if total == 0 else right / total
