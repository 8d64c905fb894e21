"""Muon: steps of equal length in all directions, for convolutions; AdamW for all else.

Sources: K. Jordan et al., "Muon: An optimizer for hidden layers in neural networks", 2024, for
the update; J. Liu et al., "Muon is Scalable for LLM Training", arXiv 2502.16982, sec. 2.2, for
the scale that lets it share AdamW's learning rate and weight decay.
"""

import torch
from torch.nn.functional import linear

# Quintic whose iterates push all singular values near 1 (Jordan et al.).
QUINTIC = (3.4445, -4.7750, 2.0315)
# AdamW moves a weight by 0.2 to 0.4 times the rate (Liu et al.): steps of that size.
STEP_SIZE = 0.2


def orthogonal(matrix, iterations=5):
    """A matrix [m, n] with the singular vectors of the given one and singular values near 1.

    Newton-Schulz iterations on the smaller side only: X -> (a + b G + c G^2) X with G = X X^T
    is a polynomial in the first G, so [m, m] products are enough until the last.
    """
    if matrix.shape[0] > matrix.shape[1]:
        return orthogonal(matrix.T, iterations).T
    start = matrix / (matrix.norm() + 1e-7)
    gram = start @ start.T
    a, b, c = QUINTIC
    unit = torch.eye(len(gram), device=gram.device, dtype=gram.dtype)
    product = unit
    for _ in range(iterations):
        factor = a * unit + (b * gram + c * (gram @ gram))
        product = factor @ product
        gram = factor @ gram @ factor
    return product @ start


def orthogonal_bf16(matrix, iterations=5):
    """The same by products of 16 bit (Jordan et al.), several times as fast where the CPU has them.

    Here the matrix itself is carried along: rounding its square would lose the small values.
    """
    if matrix.shape[0] > matrix.shape[1]:
        return orthogonal_bf16(matrix.T, iterations).T
    product = (matrix / (matrix.norm() + 1e-7)).bfloat16()
    a, b, c = QUINTIC
    for _ in range(iterations):
        gram = linear(product, product)
        product = a * product + (b * gram + c * linear(gram, gram)) @ product
    return product.float()


class Muon(torch.optim.Optimizer):
    """Groups with `orthogonal` true hold convolution weights [outputs, inputs, h, w].

    Those take steps along the orthogonal factor of their momentum (Nesterov, `momentum`), the
    other groups AdamW steps with `betas`. Every group has `lr` and decoupled `weight_decay`.
    bf16: see orthogonal_bf16.
    """

    def __init__(self, groups, lr, momentum=0.95, betas=(0.9, 0.99), bf16=False):
        super().__init__(groups, {"lr": lr, "momentum": momentum, "betas": betas,
                                  "weight_decay": 0.0, "orthogonal": False})
        self._orthogonal = orthogonal_bf16 if bf16 else orthogonal

    @torch.no_grad()
    def step(self, closure=None):
        for group in self.param_groups:
            move = self._orthogonal_step if group["orthogonal"] else self._adam_step
            for parameter in group["params"]:
                if parameter.grad is not None:
                    parameter.mul_(1 - group["lr"] * group["weight_decay"])
                    move(parameter, group)

    def _orthogonal_step(self, parameter, group):
        state, beta = self.state[parameter], group["momentum"]
        momentum = state.setdefault("momentum", torch.zeros_like(parameter))
        momentum.lerp_(parameter.grad, 1 - beta)
        ahead = parameter.grad.lerp(momentum, beta).flatten(1)
        size = STEP_SIZE * max(ahead.shape) ** 0.5
        parameter.sub_(self._orthogonal(ahead.float()).view_as(parameter), alpha=group["lr"] * size)

    def _adam_step(self, parameter, group):
        state, (first, second) = self.state[parameter], group["betas"]
        mean = state.setdefault("mean", torch.zeros_like(parameter))
        square = state.setdefault("square", torch.zeros_like(parameter))
        state["steps"] = count = state.get("steps", 0) + 1
        mean.lerp_(parameter.grad, 1 - first)
        square.lerp_(parameter.grad.square(), 1 - second)
        deviation = (square / (1 - second**count)).sqrt_().add_(1e-8)
        parameter.addcdiv_(mean, deviation, value=-group["lr"] / (1 - first**count))
