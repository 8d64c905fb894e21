"""Losses of the segmentation heads and their sum."""

import math

import torch
from torch.nn import functional

from .detail import detail_loss
from .network import upsampled

IGNORE = 255
# Of the dice term beside the cross-entropy; more makes doubtful places count as people.
REGION_WEIGHT = 0.5
AUXILIARY = ("context8", "context16")


def plain_cross_entropy(logits, labels):
    """Mean cross-entropy over the known pixels."""
    known = (labels != IGNORE).sum().clamp(min=1)
    return functional.cross_entropy(logits, labels, ignore_index=IGNORE, reduction="sum") / known


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


def region_loss(logits, labels):
    """Dice of class 1 over the whole batch: it works on the overlap that IoU scores."""
    known = (labels != IGNORE).float()
    found = torch.softmax(logits, 1)[:, 1] * known
    person = (labels == 1).float() * known
    return 1 - (2 * (found * person).sum() + 1) / (found.sum() + person.sum() + 1)


def total_loss(outputs, labels, detail_target, hard=True):
    """Sum of the losses of StdcSeg.forward_training and its parts by name.

    Without `hard` the cross-entropy is over all pixels: from random weights nearly every pixel is
    hard and many labels near edges are doubtful, and mining those slows the start of a training.
    """
    size = labels.shape[1:]
    entropy = hard_cross_entropy if hard else plain_cross_entropy
    main = upsampled(outputs["main"].float(), size)
    parts = {"main": entropy(main, labels)}
    coarse = labels[:, 1::2, 1::2]  # the auxiliary heads only guide: a quarter of the pixels will do
    for name in AUXILIARY:
        parts[name] = entropy(upsampled(outputs[name].float(), coarse.shape[1:]), coarse)
    parts["region"] = REGION_WEIGHT * region_loss(main, labels)
    known = (labels != IGNORE).float().unsqueeze(1)
    parts["detail"] = detail_loss(
        upsampled(outputs["detail"].float(), size), detail_target(labels), known
    )
    return sum(parts.values()), parts
