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


def soft_labels(labels, stride):
    """(share of person, share of known pixels), each [n, h/stride, w/stride], of squares."""
    person, known = (labels == 1).float(), (labels != IGNORE).float()
    if stride == 1:
        return person, known
    both = functional.avg_pool2d(torch.stack([person, known], 1), stride)
    return both[:, 0], both[:, 1]


def margin(logits, size):
    """By how much the person wins, [n, h, w] at `size`."""
    return upsampled(logits[:, 1:].float() - logits[:, :1].float(), size).squeeze(1)


def outline_weights(person, known, weight, reach=2):
    """1, and `weight` for the squares [n, h, w] within `reach` squares of both the person and the
    background, where the outline is drawn; arguments as soft_labels gives them."""
    grown = functional.max_pool2d(torch.stack([person, known - person], 1), 2 * reach + 1, 1, reach)
    near = (grown > 0.5).all(1)
    return 1 + (weight - 1) * near.float()


def plain_cross_entropy(margins, person, known, weights=None):
    """Mean cross-entropy over the known pixels; arguments [n, h, w], see soft_labels."""
    loss = known * functional.softplus(margins) - person * margins
    if weights is None:
        return loss.sum() / known.sum().clamp(min=1)
    return (weights * loss).sum() / (weights * known).sum().clamp(min=1)


def hard_cross_entropy(margins, person, known, threshold=0.7, least_share=1 / 16):
    """Cross-entropy over hard pixels (online hard example mining; the paper, sec. 4.1).

    Hard is a pixel whose right class has a probability below `threshold`; at least `least_share`
    of the pixels count. Arguments as for plain_cross_entropy; pixels known in part do not count.
    """
    whole = known == 1
    if not whole.any():
        return margins.sum() * 0
    loss = (functional.softplus(margins) - person * margins)[whole]
    hard = loss[loss > -math.log(threshold)]
    least = max(1, int(loss.numel() * least_share))
    if hard.numel() < least:
        hard = torch.topk(loss, least, sorted=False).values
    return hard.mean()


def region_loss(margins, person, known):
    """Dice of the person over the whole batch: it works on the overlap that IoU scores."""
    found = torch.sigmoid(margins) * known
    return 1 - (2 * (found * person).sum() + 1) / (found.sum() + person.sum() + 1)


def softened(person, known, margins, share, exact=None):
    """The labels mixed with a teacher's probabilities, which weigh `share` of 1.

    exact [n]: 1 for images whose labels are right, which the teacher does not soften where it says
    the opposite: its mistakes need not be learnt.
    """
    mixed = (1 - share) * person + share * known * torch.sigmoid(margins)
    if exact is None:
        return mixed
    opposite = (margins > 0) != (person > 0.5 * known)
    return torch.where(opposite & (exact != 0).view(-1, 1, 1), person, mixed)


def without_doubt(labels, exact, teacher, certain=0.9):
    """The labels [n, h, w], unknown where a teacher is certain of the opposite and they come from
    another network (exact [n] is 0): one of the two is wrong, often the label."""
    chance = torch.sigmoid(margin(teacher, labels.shape[1:]))
    opposite = ((labels == 1) & (chance < 1 - certain)) | ((labels == 0) & (chance > certain))
    return torch.where(opposite & (exact == 0).view(-1, 1, 1), IGNORE, labels)


def total_loss(outputs, labels, detail_target, hard=True, stride=1, teacher=None, share=0.5,
               exact=None, outline=1.0):
    """Sum of the losses of StdcSeg.forward_training (its heads of training may be missing) and
    its parts by name.

    Without `hard` the cross-entropy is over all pixels: from random weights nearly every pixel is
    hard and many labels near edges are doubtful, and mining those slows the start of a training.
    Squares of `stride` pixels count as one, with the shares of their labels; the auxiliary heads
    only guide, and squares twice as long will do for them. teacher: logits [n, 2, h/8, w/8] of
    another network that soften the labels, with `share` and `exact`: see softened. outline: how
    much squares near outlines count in the cross-entropy of the main head, if not hard.
    """
    def targets(stride):
        person, known = soft_labels(labels, stride)
        if teacher is not None:
            person = softened(person, known, margin(teacher, person.shape[1:]), share,
                              exact)
        return person, known

    entropy = hard_cross_entropy if hard else plain_cross_entropy
    fine = targets(stride)
    size = fine[0].shape[1:]
    main = margin(outputs["main"], size)
    near = {}
    if outline != 1 and not hard:
        near["weights"] = outline_weights(*soft_labels(labels, stride), outline)
    parts = {"main": entropy(main, *fine, **near)}
    parts["region"] = REGION_WEIGHT * region_loss(main, *fine)
    if "detail" in outputs:
        coarse = targets(2 * stride)
        for name in AUXILIARY:
            parts[name] = entropy(margin(outputs[name], coarse[0].shape[1:]), *coarse)
        edges = functional.avg_pool2d(detail_target(labels), stride)
        detail = upsampled(outputs["detail"].float(), size)
        parts["detail"] = detail_loss(detail, edges, fine[1].unsqueeze(1))
    return sum(parts.values()), parts
