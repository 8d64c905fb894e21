"""STDC1-Seg and STDC2-Seg (the paper, table 2 and fig. 2)."""

import torch
from torch import nn
from torch.nn import functional

from .layers import AttentionRefinement, ConvX, FeatureFusion, Head, StdcModule

MODULES = {"STDC1-Seg": (2, 2, 2), "STDC2-Seg": (4, 5, 3)}


class Widths:
    """Channel counts. `divisor` narrows backbone, context and fusion; 1 is the paper's network.

    The segmentation head has 64 channels instead of the paper's 256: with two classes it costs
    an eighth of the whole network otherwise and gains nothing.
    """

    def __init__(self, divisor=1, head=64):
        self.stages = tuple(n // divisor for n in (32, 64, 256, 512, 1024))
        self.context = 128 // divisor
        self.fusion = 256 // divisor
        self.head = head


class Backbone(nn.Module):
    """STDC backbone: features of stages 3, 4 and 5 at 1/8, 1/16 and 1/32 of the image."""

    def __init__(self, counts, widths):
        super().__init__()
        n = widths.stages
        self.stage1 = ConvX(3, n[0], stride=2)
        self.stage2 = ConvX(n[0], n[1], stride=2)
        self.stage3 = self._stage(n[1], n[2], counts[0])
        self.stage4 = self._stage(n[2], n[3], counts[1])
        self.stage5 = self._stage(n[3], n[4], counts[2])

    @staticmethod
    def _stage(inputs, outputs, count):
        first = [StdcModule(inputs, outputs, 2)]
        return nn.Sequential(*first, *[StdcModule(outputs, outputs, 1) for _ in range(count - 1)])

    def forward(self, image):
        eighth = self.stage3(self.stage2(self.stage1(image)))
        sixteenth = self.stage4(eighth)
        return eighth, sixteenth, self.stage5(sixteenth)


class ContextPath(nn.Module):
    """Context features at 1/16 and 1/8 from stages 4 and 5, with the global average added."""

    def __init__(self, widths):
        super().__init__()
        middle = widths.context
        self.pool = ConvX(widths.stages[4], middle, kernel=1)
        self.arm5 = AttentionRefinement(widths.stages[4], middle)
        self.arm4 = AttentionRefinement(widths.stages[3], middle)
        self.head5 = ConvX(middle, middle)
        self.head4 = ConvX(middle, middle)

    def forward(self, stage4, stage5):
        deep = self.arm5(stage5) + self.pool(stage5.mean((2, 3), keepdim=True))
        sixteenth = self.head5(functional.interpolate(deep, scale_factor=2.0, mode="nearest"))
        merged = self.arm4(stage4) + sixteenth
        eighth = self.head4(functional.interpolate(merged, scale_factor=2.0, mode="nearest"))
        return sixteenth, eighth


class StdcSeg(nn.Module):
    """The whole network; with `training_heads` also the heads that only training needs.

    forward(image [n, 3, h, w] normalised; h and w multiples of 32) returns logits
    [n, classes, h/8, w/8]. forward_training returns a dict of logits: "main" (1/8),
    "context8" (1/8), "context16" (1/16) and "detail" [n, 1, h/8, w/8] of the detail guidance
    on stage 3 (the paper, sec. 3.3).
    """

    def __init__(self, architecture="STDC1-Seg", classes=2, divisor=1, head=64,
                 training_heads=True):
        super().__init__()
        if architecture not in MODULES:
            raise ValueError(f"unknown architecture {architecture!r}: use one of {sorted(MODULES)}")
        widths = Widths(divisor, head)
        self.architecture = architecture
        self.backbone = Backbone(MODULES[architecture], widths)
        self.context = ContextPath(widths)
        self.ffm = FeatureFusion(widths.stages[2] + widths.context, widths.fusion)
        self.head = Head(widths.fusion, widths.head, classes)
        if training_heads:
            self.auxiliary8 = Head(widths.context, widths.head, classes)
            self.auxiliary16 = Head(widths.context, widths.head, classes)
            self.detail = Head(widths.stages[2], widths.head, 1)
        self._initialise()

    def _initialise(self):
        for module in self.modules():
            if isinstance(module, nn.Conv2d):
                nn.init.kaiming_normal_(module.weight, nonlinearity="relu")
                if module.bias is not None:
                    nn.init.zeros_(module.bias)

    def forward(self, image):
        stage3, stage4, stage5 = self.backbone(image)
        return self.head(self.ffm(stage3, self.context(stage4, stage5)[1]))

    def forward_training(self, image):
        stage3, stage4, stage5 = self.backbone(image)
        sixteenth, eighth = self.context(stage4, stage5)
        return {
            "main": self.head(self.ffm(stage3, eighth)),
            "context8": self.auxiliary8(eighth),
            "context16": self.auxiliary16(sixteenth),
            "detail": self.detail(stage3),
        }


TRAINING_ONLY = ("auxiliary8.", "auxiliary16.", "detail.")


def inference_state(network):
    """The tensors that inference needs: name -> tensor, without the training heads."""
    state = network.state_dict()
    return {
        name: tensor
        for name, tensor in state.items()
        if not name.startswith(TRAINING_ONLY) and not name.endswith("num_batches_tracked")
    }


def upsampled(logits, size):
    """Logits at `size` (height, width), bilinear with half-pixel centres."""
    return functional.interpolate(logits, size=size, mode="bilinear", align_corners=False)


def default_device():
    """The GPU if there is one, else the CPU."""
    return torch.device("cuda" if torch.cuda.is_available() else "cpu")
