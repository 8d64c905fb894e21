"""A slim network from a wide one: python3 -m stdc_training.prune WIDE DATA SLIM --share 0.28.

Channels go where the network says nearly the same without them (channel_choice). The layers that
remain take over by regression, then each is fitted anew, in the order of the data, to what the
wide network has in its place (Y. He et al., "Channel Pruning for Accelerating Very Deep Neural
Networks", ICCV 2017). The slim file is a start for a training:
`stdc_training.train --channels SLIM --start-from SLIM --teacher WIDE`.
"""

import argparse
import json

import numpy as np
import torch
from torch.nn import functional

from . import channel_choice, weights
from .layers import ConvX
from .network import StdcSeg
from .samples import Samples

RIDGE = 3e-3
PLACES = 192  # of an image that a layer is fitted to, at most


def batches_of(folder, size, count, batch=8):
    """Normalised training samples, the same in each call."""
    samples = Samples(folder, size, count, seed=77, strength=0.5)
    for begin in range(0, count, batch):
        yield weights.normalised(torch.stack([samples[i][0] for i in range(begin, begin + batch)]))


def wiring(widths):
    """{tensor of a convolution's weights: (groups of its inputs, group of its outputs)}.

    None stands for the image, for the classes and for channels that all stay.
    """
    def outputs(stage):
        last = len(widths.stages[stage - 3]) - 1
        return [f"backbone.stage{stage}.{last}.blocks.{k}" for k in range(4)]

    found = {"backbone.stage1.conv": (None, "backbone.stage1"),
             "backbone.stage2.conv": (["backbone.stage1"], "backbone.stage2")}
    inputs = ["backbone.stage2"]
    for stage, modules in enumerate(widths.stages, 3):
        for i in range(len(modules)):
            own = [f"backbone.stage{stage}.{i}.blocks.{k}" for k in range(4)]
            for name, source in zip(own, [inputs, *([n] for n in own[:3])]):
                found[name + ".conv"] = (source, name)
            inputs = own
    deep, sixteenth, eighth = "context.deep", "context.sixteenth", "context.eighth"
    found["context.pool.conv"] = (outputs(5), deep)
    for arm, stage, group in (("arm5", 5, deep), ("arm4", 4, sixteenth)):
        found[f"context.{arm}.conv.conv"] = (outputs(stage), group)
        found[f"context.{arm}.attention.conv"] = ([group], group)
    found["context.head5.conv"] = ([deep], sixteenth)
    found["context.head4.conv"] = ([sixteenth], eighth)
    found["ffm.conv.conv"] = ([*outputs(3), eighth], "fusion")
    found["ffm.squeeze"] = (["fusion"], None)
    found["ffm.excite"] = (None, "fusion")
    found["head.conv.conv"] = (["fusion"], "head")
    found["head.classify"] = (["head"], None)
    return found


@torch.no_grad()
def fold(wide, slim, kept, moments):
    """Fill `slim` with the kept channels of `wide`; the others' part comes by regression."""
    parts = dict(wide.named_modules())
    others = dict(slim.named_modules())
    maps = {name: torch.from_numpy(channel_choice.regression(moments[name][0], kept[name])).float()
            for name in kept}
    for name, (inputs, output) in wiring(wide.widths).items():
        weight = parts[name].weight
        rows = torch.as_tensor(kept[output]) if output else torch.arange(len(weight))
        weight = weight[rows]
        if inputs:
            weight = torch.einsum("oikl,is->oskl", weight,
                                  torch.block_diag(*(maps[group] for group in inputs)))
        others[name].weight.copy_(weight)
        if parts[name].bias is not None:
            others[name].bias.copy_(parts[name].bias[rows])
        if name.endswith(".conv"):
            unit = name.removesuffix(".conv") + ".bn"
            for field in ("weight", "bias", "running_mean", "running_var"):
                getattr(others[unit], field).copy_(getattr(parts[unit], field)[rows])


class _Seen(Exception):
    """Ends a forward pass whose rest nobody needs."""


def _places(shape, image):
    """Indices into the places of a map [h, w] of image number `image`."""
    count = shape[0] * shape[1]
    if count <= PLACES:
        return torch.arange(count)
    return torch.from_numpy(np.random.default_rng([image, count]).permutation(count)[:PLACES])


@torch.no_grad()
def targets(wide, kept, layers, batches):
    """{ConvX: [samples, kept channels]} before the ReLU at the chosen places of all images."""
    found, first = {name: [] for name in layers}, 0

    def collect(name, rows):
        def hook(_, inputs, output):
            for i, image in enumerate(output[:, rows]):
                found[name].append(image.flatten(1)[:, _places(image.shape[1:], first + i)].T)
        return hook

    parts = dict(wide.named_modules())
    groups = {name: group for name, (_, group) in wiring(wide.widths).items()}
    handles = [parts[name + ".bn"].register_forward_hook(
        collect(name, torch.as_tensor(kept[groups[name + ".conv"]]))) for name in layers]
    for batch in batches:
        wide(batch)
        first += len(batch)
    for handle in handles:
        handle.remove()
    return {name: torch.cat(pieces) for name, pieces in found.items()}


@torch.no_grad()
def fit(slim, name, wanted, batches):
    """Fit the ConvX `name` to `wanted` [samples, outputs], its values before the ReLU."""
    unit = dict(slim.named_modules())[name]
    conv = unit.conv
    side = conv.weight[0].numel() + 1  # and one for the offset
    gram, right = torch.zeros(side, side).double(), torch.zeros(side, len(conv.weight)).double()
    first = 0

    def collect(_, inputs):
        nonlocal first, gram, right
        shape = [(n - 1) // conv.stride[0] + 1 for n in inputs[0].shape[2:]]
        places = [_places(shape, first + i) for i in range(len(inputs[0]))]
        rows = []
        for image, chosen in zip(inputs[0], places):
            patches = functional.unfold(image[None], conv.kernel_size, padding=conv.padding,
                                        stride=conv.stride)[0]
            rows.append(patches[:, chosen].T)
        begin = sum(len(_places(shape, i)) for i in range(first))
        rows = torch.cat(rows)
        rows = torch.cat([rows, torch.ones(len(rows), 1)], 1)
        gram += (rows.T @ rows).double()
        right += (rows.T @ wanted[begin:begin + len(rows)]).double()
        first += len(inputs[0])
        raise _Seen

    handle = conv.register_forward_pre_hook(collect)
    for batch in batches:
        try:
            slim(batch)
        except _Seen:
            pass
    handle.remove()
    scale = unit.bn.weight / (unit.bn.running_var + unit.bn.eps).sqrt()
    before = torch.cat([(conv.weight.flatten(1) * scale[:, None]).T,
                        (unit.bn.bias - unit.bn.running_mean * scale)[None]]).double()
    keep = RIDGE * torch.trace(gram[:-1, :-1]) / (side - 1) * torch.eye(side).double()
    found = before + torch.linalg.solve(gram + keep, right - gram @ before)
    _set_unit(unit, found, gram)


def _set_unit(unit, found, gram):
    """Weights and offset `found` [inputs + 1, outputs], normalised by what the layer sees.

    The weights stay as large as they were, because their size before the normalisation, which
    otherwise means nothing, decides how far a training step turns them.
    """
    samples, sums = gram[-1, -1], gram[-1, :-1]
    size = unit.conv.weight.square().mean().sqrt() / found[:-1].square().mean().sqrt()
    weight = size * found[:-1]
    mean = sums @ weight / samples
    square = torch.einsum("io,ij,jo->o", weight, gram[:-1, :-1], weight) / samples
    variance = (square - mean**2).clamp(min=1e-9)
    unit.conv.weight.copy_(weight.T.reshape(unit.conv.weight.shape))
    unit.bn.running_mean.copy_(mean)
    unit.bn.running_var.copy_(variance)
    unit.bn.weight.copy_((variance + unit.bn.eps).sqrt() / size)
    unit.bn.bias.copy_(found[-1] + mean / size)


def prune(wide, size, share, batches, fitted=True, report=print):
    """The slim StdcSeg with `share` of the multiplications at `size`.

    batches: a function that gives normalised images, the same in each call.
    """
    wide.requires_grad_(False)
    moments = channel_choice.moments(wide, batches())
    gone = {name: channel_choice.elimination(*pair) for name, pair in moments.items()}
    full = channel_choice.multiplications(wide.widths, size)
    widths = channel_choice.spend(wide.widths, {n: errors for n, (_, errors) in gone.items()},
                                  size, share * full)
    counts, before = channel_choice.counts_of(widths), channel_choice.counts_of(wide.widths)
    kept = {}
    for name, count in counts.items():
        kept[name] = np.setdiff1d(np.arange(before[name]), gone[name][0][:before[name] - count])
        error = gone[name][1][before[name] - count - 1] if count < before[name] else 0
        report(f"{name:32} {before[name]:4} -> {count:4}  error {error:.3g}")
    slim = StdcSeg(wide.architecture, classes=wide.head.classify.out_channels, widths=widths,
                   training_heads=False).eval()
    fold(wide, slim, kept, moments)
    report(f"{channel_choice.multiplications(widths, size) / 1e6:.0f} of {full / 1e6:.0f} million")
    if fitted:
        spatial = [name for name, part in wide.named_modules() if isinstance(part, ConvX)
                   and name not in ("backbone.stage1", "context.pool")]
        wanted = targets(wide, kept, spatial, batches())
        for name in spatial:
            fit(slim, name, wanted[name], batches())
            report(f"fitted {name}")
    return slim


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("wide", help="weights file")
    parser.add_argument("data", help="folder of packed training data")
    parser.add_argument("slim", help="weights file that is written")
    parser.add_argument("--share", type=float, default=0.28, help="of the multiplications, 0..1")
    parser.add_argument("--size", type=int, nargs=2, default=(320, 256), metavar=("W", "H"))
    parser.add_argument("--images", type=int, default=128, help="to measure and fit on")
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    torch.set_num_threads(options.threads)
    wide, entries = weights.load(options.wide)
    batches = list(batches_of(options.data, options.size, options.images))
    slim = prune(wide, options.size, options.share, lambda: batches)
    size = int(entries["input_width"]), int(entries["input_height"])
    notes = weights.metadata(slim, size, entries["licence"], None, json.loads(entries["classes"]),
                             json.loads(entries["dynamic_classes"]))
    weights.save(options.slim, slim, notes)


if __name__ == "__main__":
    main()
