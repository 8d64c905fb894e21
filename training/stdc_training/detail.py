"""Detail guidance (the paper, sec. 3.3): stage 3 learns where the edges of the labels are."""

import torch
from torch import nn
from torch.nn import functional

STRIDES = (1, 2, 4)
THRESHOLD = 0.1


class DetailTarget(nn.Module):
    """Binary detail map [n, 1, h, w] from labels [n, h, w].

    A Laplacian at strides 1, 2 and 4 marks edges at three scales; they are brought to full size
    and fused by a 1x1 convolution with trainable weights, and thresholded at 0.1. The weights are
    a softmax, so that they cannot all sink below the threshold (an empty target would make the
    loss trivially small), and get their gradient straight through the threshold.
    """

    def __init__(self):
        super().__init__()
        self.fuse = nn.Parameter(torch.zeros(len(STRIDES)))

    @staticmethod
    def _edges(labels):
        """Where the Laplacian of the person map is above the threshold, as a boolean map.

        For a map of zeros and ones that is where a person pixel has a neighbour that is none,
        and comparing neighbours is quicker than convolving.
        """
        person = labels == 1
        whole = person.clone()
        whole[:, 1:] &= person[:, :-1]
        whole[:, :-1] &= person[:, 1:]
        rows = whole.clone()
        whole[:, :, 1:] &= rows[:, :, :-1]
        whole[:, :, :-1] &= rows[:, :, 1:]
        return person & ~whole

    def forward(self, labels):
        marked = self._edges(labels).float().unsqueeze(1)
        weights = torch.softmax(self.fuse, 0)
        soft = 0
        for weight, stride in zip(weights, STRIDES):
            edges = marked[:, :, ::stride, ::stride]
            if stride > 1:
                edges = functional.interpolate(edges, size=labels.shape[1:], mode="nearest")
            soft = soft + weight * edges
        hard = (soft > THRESHOLD).float()
        return hard + soft - soft.detach()


def detail_loss(logits, target, known):
    """Binary cross-entropy + dice (the paper, eq. 2 and 3).

    logits, target: [n, 1, h, w]; known: [n, 1, h, w] float, 0 where the label is to be ignored.
    Dice copes with the few edge pixels; its +1 keeps empty maps defined.
    """
    entropy = functional.binary_cross_entropy_with_logits(logits, target, reduction="none")
    entropy = (entropy * known).sum() / known.sum().clamp(min=1)
    found = torch.sigmoid(logits) * known
    target = target * known
    overlap = (found * target).sum((1, 2, 3))
    total = (found * found).sum((1, 2, 3)) + (target * target).sum((1, 2, 3))
    return entropy + (1 - (2 * overlap + 1) / (total + 1)).mean()
