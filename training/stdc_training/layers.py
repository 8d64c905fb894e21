"""Building blocks of the STDC networks.

Source: M. Fan et al., "Rethinking BiSeNet For Real-time Semantic Segmentation", CVPR 2021,
called "the paper" in this package; BiSeNet (C. Yu et al., ECCV 2018) for the attention modules.
Tensors are [batch, channels, height, width]. The attribute names are the tensor names of the
exported weights file, so renaming one breaks the C++ reader.
"""

import torch
from torch import nn


class ConvX(nn.Module):
    """Convolution, batch normalisation, ReLU: the unit of which all else is made."""

    def __init__(self, inputs, outputs, kernel=3, stride=1):
        super().__init__()
        self.conv = nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, bias=False)
        self.bn = nn.BatchNorm2d(outputs)

    def forward(self, x):
        return torch.relu(self.bn(self.conv(x)))


class StdcModule(nn.Module):
    """Short-Term Dense Concatenate module (the paper, fig. 3).

    Four ConvX with the channels `outputs`, in the paper 1/2, 1/4, 1/8 and 1/8 of the module's;
    all four outputs are concatenated, so that one module sees several receptive fields. With
    stride 2 the second block halves the size, and the first block's output is average-pooled to fit.
    """

    def __init__(self, inputs, outputs, stride):
        super().__init__()
        self.blocks = nn.ModuleList(
            [
                ConvX(inputs, outputs[0], kernel=1),
                ConvX(outputs[0], outputs[1], stride=stride),
                ConvX(outputs[1], outputs[2]),
                ConvX(outputs[2], outputs[3]),
            ]
        )
        self.pool = nn.AvgPool2d(3, 2, 1) if stride == 2 else nn.Identity()

    def forward(self, x):
        outputs = [self.blocks[0](x)]
        for block in self.blocks[1:]:
            outputs.append(block(outputs[-1]))
        outputs[0] = self.pool(outputs[0])
        return torch.cat(outputs, 1)


class ChannelGate(nn.Module):
    """Weights of the channels in 0..1, [batch, channels, 1, 1], from the global average."""

    def __init__(self, channels):
        super().__init__()
        self.conv = nn.Conv2d(channels, channels, 1, bias=False)
        self.bn = nn.BatchNorm2d(channels)

    def forward(self, x):
        return torch.sigmoid(self.bn(self.conv(x.mean((2, 3), keepdim=True))))


class AttentionRefinement(nn.Module):
    """Attention refinement module (BiSeNet, fig. 2b): a 3x3 ConvX whose channels are gated."""

    def __init__(self, inputs, outputs):
        super().__init__()
        self.conv = ConvX(inputs, outputs)
        self.attention = ChannelGate(outputs)

    def forward(self, x):
        feature = self.conv(x)
        return feature * self.attention(feature)


class FeatureFusion(nn.Module):
    """Feature fusion module (BiSeNet, fig. 2c) of detail (stage 3) and context features."""

    def __init__(self, inputs, outputs, middle):
        super().__init__()
        self.conv = ConvX(inputs, outputs, kernel=1)
        self.squeeze = nn.Conv2d(outputs, middle, 1, bias=False)
        self.excite = nn.Conv2d(middle, outputs, 1, bias=False)

    def forward(self, detail, context):
        feature = self.conv(torch.cat([detail, context], 1))
        gate = torch.relu(self.squeeze(feature.mean((2, 3), keepdim=True)))
        return feature * torch.sigmoid(self.excite(gate)) + feature


class Head(nn.Module):
    """3x3 ConvX and a 1x1 classifier: logits at the resolution of the feature."""

    def __init__(self, inputs, middle, classes):
        super().__init__()
        self.conv = ConvX(inputs, middle)
        self.classify = nn.Conv2d(middle, classes, 1)

    def forward(self, x):
        return self.classify(self.conv(x))
