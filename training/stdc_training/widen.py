"""A wide network that begins as a narrow, trained one: it computes the same, and has room to learn.

After T. Chen et al., "Net2Net: Accelerating Learning via Knowledge Transfer", ICLR 2016, but
without copies of channels, which would learn the same from the same gradients: the new channels
begin with random weights, and what was there before does not listen to them yet.
"""

import torch

from .layers import AttentionRefinement, ConvX, FeatureFusion, Head, StdcModule


def _module_channels(narrow, wide):
    """Where the channels of a narrow StdcModule's output stand among a wide one's."""
    places, begin = [], 0
    for one, other in zip(narrow.blocks, wide.blocks):
        places.append(begin + torch.arange(one.conv.out_channels))
        begin += other.conv.out_channels
    return torch.cat(places)


def _fill_convolution(narrow, wide, inputs, outputs):
    """Old weights to their places; old outputs take nothing from new inputs."""
    wide.weight[outputs] = 0
    wide.weight[outputs[:, None], inputs] = narrow.weight
    if narrow.bias is not None:
        wide.bias[outputs] = narrow.bias


def _fill_statistics(narrow, wide, outputs):
    for name in ("weight", "bias", "running_mean", "running_var"):
        getattr(wide, name)[outputs] = getattr(narrow, name)


def _fill_unit(narrow, wide, inputs):
    """A ConvX or a ChannelGate; returns the places of its outputs."""
    outputs = torch.arange(narrow.conv.out_channels)
    _fill_convolution(narrow.conv, wide.conv, inputs, outputs)
    _fill_statistics(narrow.bn, wide.bn, outputs)
    return outputs


def _fill_module(narrow, wide, inputs):
    for one, other in zip(narrow.blocks, wide.blocks):
        inputs = _fill_unit(one, other, inputs)
    return _module_channels(narrow, wide)


def _fill_attention(narrow, wide, inputs):
    outputs = _fill_unit(narrow.conv, wide.conv, inputs)
    return _fill_unit(narrow.attention, wide.attention, outputs)


def _fill_fusion(narrow, wide, inputs):
    outputs = _fill_unit(narrow.conv, wide.conv, inputs)
    middle = torch.arange(narrow.squeeze.out_channels)
    _fill_convolution(narrow.squeeze, wide.squeeze, outputs, middle)
    _fill_convolution(narrow.excite, wide.excite, middle, outputs)
    return outputs


def _fill_head(narrow, wide, inputs):
    middle = _fill_unit(narrow.conv, wide.conv, inputs)
    classes = torch.arange(narrow.classify.out_channels)
    _fill_convolution(narrow.classify, wide.classify, middle, classes)
    return classes


FILLERS = {ConvX: _fill_unit, StdcModule: _fill_module, AttentionRefinement: _fill_attention,
           FeatureFusion: _fill_fusion, Head: _fill_head}


def _fill(narrow, wide, inputs):
    """Fill a part by its kind; a row of parts one after the other."""
    if isinstance(narrow, torch.nn.Sequential):
        for one, other in zip(narrow, wide):
            inputs = _fill(one, other, inputs)
        return inputs
    return FILLERS[type(narrow)](narrow, wide, inputs)


@torch.no_grad()
def widen(narrow, wide):
    """Fill the StdcSeg `wide` so that it gives the logits of the StdcSeg `narrow`.

    Both of the same architecture; no layer of `wide` may be narrower. The heads of training are
    filled where both networks have them.
    """
    stages, channels = {}, torch.arange(3)
    for name in ("stage1", "stage2", "stage3", "stage4", "stage5"):
        one, other = (getattr(network.backbone, name) for network in (narrow, wide))
        stages[name] = channels = _fill(one, other, channels)
    one, other = narrow.context, wide.context
    _fill(one.pool, other.pool, stages["stage5"])
    deep = _fill(one.arm5, other.arm5, stages["stage5"])
    _fill(one.arm4, other.arm4, stages["stage4"])
    sixteenth = _fill(one.head5, other.head5, deep)
    context = _fill(one.head4, other.head4, sixteenth)
    before_context = wide.ffm.conv.conv.in_channels - other.head4.conv.out_channels
    fused = _fill(narrow.ffm, wide.ffm, torch.cat([stages["stage3"], before_context + context]))
    _fill(narrow.head, wide.head, fused)
    sources = {"auxiliary8": context, "auxiliary16": sixteenth, "detail": stages["stage3"]}
    for name, channels in sources.items():
        if hasattr(narrow, name) and hasattr(wide, name):
            _fill(getattr(narrow, name), getattr(wide, name), channels)
