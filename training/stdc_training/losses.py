"""Losses of the segmentation heads and their sum."""

import math

import torch
from torch.nn import functional

from .detail import detail_loss
from .network import upsampled

IGNORE = 255


def hard_cross_entropy(logits, labels, threshold=0.7, least_share=1 / 16):
    """Cross-entropy over hard pixels (online hard example mining; the paper, sec. 4.1).

    Hard is a pixel whose right class has a probability below `threshold`; at least `least_share`
    of the pixels count. logits [n, classes, h, w], labels [n, h, w] with 255 = ignore.
    """
    loss = functional.cross_entropy(logits, labels, ignore_index=IGNORE, reduction="none")
    known = loss[labels != IGNORE]
    if known.numel() == 0:
        return logits.sum() * 0
    hard = known[known > -math.log(threshold)]
    least = max(1, int(known.numel() * least_share))
    if hard.numel() < least:
        hard = torch.topk(known, least, sorted=False).values
    return hard.mean()


def total_loss(outputs, labels, detail_target):
    """Sum of the losses of StdcSeg.forward_training and its parts by name."""
    size = labels.shape[1:]
    parts = {
        name: hard_cross_entropy(upsampled(outputs[name].float(), size), labels)
        for name in ("main", "context8", "context16")
    }
    known = (labels != IGNORE).float().unsqueeze(1)
    parts["detail"] = detail_loss(
        upsampled(outputs["detail"].float(), size), detail_target(labels), known
    )
    return sum(parts.values()), parts
