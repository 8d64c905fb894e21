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
        kernel = -torch.ones(1, 1, 3, 3)
        kernel[0, 0, 1, 1] = 8
        self.register_buffer("kernel", kernel)

    def forward(self, labels):
        person = (labels == 1).float().unsqueeze(1)
        padded = functional.pad(person, (1, 1, 1, 1), mode="replicate")
        weights = torch.softmax(self.fuse, 0)
        soft = 0
        for weight, stride in zip(weights, STRIDES):
            edges = functional.conv2d(padded, self.kernel, stride=stride).clamp(min=0)
            edges = (edges > THRESHOLD).float()
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
