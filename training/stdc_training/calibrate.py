"""Ranges of the activations for int8 inference (post-training calibration by percentile).

The range of a convolution is that of its input tensor. Rare extremes would waste most of the
256 steps, so the range ends at a percentile of the values seen over all calibration images.
"""

import numpy as np
import torch
from torch import nn

PERCENTILE = 99.99
SAMPLES_PER_IMAGE = 1 << 14


def activation_ranges(network, batches, percentile=PERCENTILE):
    """{layer name: [low, high]} over batches of normalised images [n, 3, h, w].

    Layer names are those of the convolutions in the weights file; "input" is the network's own.
    Low is 0 where an input is never negative (after ReLU or a sigmoid gate).
    """
    samples = {"input": []}
    rng = np.random.default_rng(0)

    def collect(name, tensor):
        values = tensor.detach().flatten().cpu().numpy()
        if values.size > SAMPLES_PER_IMAGE * tensor.shape[0]:
            values = values[rng.integers(0, values.size, SAMPLES_PER_IMAGE * tensor.shape[0])]
        samples[name].append(values)

    handles = []
    for name, module in network.named_modules():
        if isinstance(module, nn.Conv2d):
            samples[name] = []
            handles.append(module.register_forward_hook(
                lambda _, inputs, __, name=name: collect(name, inputs[0])))
    try:
        with torch.no_grad():
            for batch in batches:
                collect("input", batch)
                network(batch)
    finally:
        for handle in handles:
            handle.remove()
    return {name: _range(np.concatenate(values), percentile) for name, values in samples.items()}


def _range(values, percentile):
    low, high = float(values.min()), float(np.percentile(values, percentile))
    if low < 0:
        low = float(np.percentile(values, 100 - percentile))
    return [round(min(low, 0.0), 6), round(max(high, 1e-6), 6)]
