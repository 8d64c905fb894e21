"""Exponential moving average of a network's parameters and statistics."""

import copy

import torch


class Average:
    """`network` follows another one: average = decay * average + (1 - decay) * current.

    The decay starts low, so that the first, random weights are soon forgotten.
    """

    def __init__(self, network, decay=0.998):
        self.network = copy.deepcopy(network).eval()
        for parameter in self.network.parameters():
            parameter.requires_grad_(False)
        self._decay = decay
        self.updates = 0

    @torch.no_grad()
    def update(self, network):
        self.updates += 1
        decay = min(self._decay, (1 + self.updates) / (10 + self.updates))
        for mine, other in zip(self.network.state_dict().values(), network.state_dict().values()):
            if mine.dtype.is_floating_point:
                mine.lerp_(other, 1 - decay)
            else:
                mine.copy_(other)
