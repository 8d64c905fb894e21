"""STDC1-Seg and STDC2-Seg (the paper, table 2 and fig. 2)."""

import torch
from torch import nn
from torch.nn import functional

from .layers import AttentionRefinement, ConvX, FeatureFusion, Head, StdcModule
from .widths import Widths


class Backbone(nn.Module):
    """STDC backbone: features of stages 3, 4 and 5 at 1/8, 1/16 and 1/32 of the image."""

    def __init__(self, widths):
        super().__init__()
        self.stage1 = ConvX(3, widths.stem[0], stride=2)
        self.stage2 = ConvX(widths.stem[0], widths.stem[1], stride=2)
        channels, self.outputs = widths.stem[1], []
        for number, modules in enumerate(widths.stages, 3):
            stage = nn.Sequential()
            for i, outputs in enumerate(modules):
                stage.append(StdcModule(channels, outputs, 2 if i == 0 else 1))
                channels = sum(outputs)
            setattr(self, f"stage{number}", stage)
            self.outputs.append(channels)

    def forward(self, image):
        eighth = self.stage3(self.stage2(self.stage1(image)))
        sixteenth = self.stage4(eighth)
        return eighth, sixteenth, self.stage5(sixteenth)


class ContextPath(nn.Module):
    """Context features at 1/16 and 1/8 from stages 4 and 5, with the global average added."""

    def __init__(self, stage4, stage5, widths):
        super().__init__()
        deep, sixteenth, eighth = widths
        self.pool = ConvX(stage5, deep, kernel=1)
        self.arm5 = AttentionRefinement(stage5, deep)
        self.arm4 = AttentionRefinement(stage4, sixteenth)
        self.head5 = ConvX(deep, sixteenth)
        self.head4 = ConvX(sixteenth, eighth)

    def forward(self, stage4, stage5):
        deep = self.arm5(stage5) + self.pool(stage5.mean((2, 3), keepdim=True))
        sixteenth = self.head5(functional.interpolate(deep, scale_factor=2.0, mode="nearest"))
        merged = self.arm4(stage4) + sixteenth
        eighth = self.head4(functional.interpolate(merged, scale_factor=2.0, mode="nearest"))
        return sixteenth, eighth


class StdcSeg(nn.Module):
    """The whole network; with `training_heads` also the heads that only training needs.

    forward(image [n, 3, h, w] normalised; h and w multiples of 32) returns logits
    [n, classes, h/8, w/8]. forward_training returns a dict of logits: "main" (1/8) and, with
    `training_heads`, "context8" (1/8), "context16" (1/16) and "detail" [n, 1, h/8, w/8] of the
    detail guidance on stage 3 (the paper, sec. 3.3).
    """

    def __init__(self, architecture="STDC1-Seg", classes=2, divisor=1, head=64,
                 training_heads=True, widths=None):
        """widths: the channels of all layers, instead of `divisor` and `head`."""
        super().__init__()
        widths = widths or Widths.uniform(architecture, divisor, head)
        self.architecture, self.widths = architecture, widths
        self.backbone = Backbone(widths)
        stage3, stage4, stage5 = self.backbone.outputs
        self.context = ContextPath(stage4, stage5, widths.context)
        self.ffm = FeatureFusion(stage3 + widths.context[2], widths.fusion, widths.squeeze)
        self.head = Head(widths.fusion, widths.head, classes)
        if training_heads:
            self.auxiliary8 = Head(widths.context[2], widths.head, classes)
            self.auxiliary16 = Head(widths.context[1], widths.head, classes)
            self.detail = Head(stage3, widths.head, 1)
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
        outputs = {"main": self.head(self.ffm(stage3, eighth))}
        if hasattr(self, "detail"):
            outputs["context8"] = self.auxiliary8(eighth)
            outputs["context16"] = self.auxiliary16(sixteenth)
            outputs["detail"] = self.detail(stage3)
        return outputs


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
