"""Which channels of a trained network are worth their multiplications.

Of each group of channels (the outputs of a layer, as its readers see them) two matrices are
measured: the second moments S of the values, and those of their gradients, G. If only the channels
K are kept and the readers get the others by linear regression on them, what the network says
changes by about sum(G * R) over the places of the group, where R = S - S[:, K] S[K, K]^-1 S[K, :]
is what the regression cannot know (the Kronecker approximation of J. Martens and R. Grosse,
"Optimizing Neural Networks with Kronecker-factored Approximate Curvature", ICML 2015; removal with
compensation as in B. Hassibi and D. Stork, "Second order derivatives for network pruning: Optimal
Brain Surgeon", NIPS 1992). The groups are comparable, so a budget can be spent over all of them.
"""

import numpy as np
import torch

from .widths import Widths

RIDGE = 1e-4
CHUNK = 16  # channels that the kernels take at a time
LEAST_SHARE = 0.25


def group_names(widths):
    """Names of the groups in the order of the data."""
    names = ["backbone.stage1", "backbone.stage2"]
    for stage, modules in enumerate(widths.stages, 3):
        for i in range(len(modules)):
            names += [f"backbone.stage{stage}.{i}.blocks.{k}" for k in range(4)]
    return names + ["context.deep", "context.sixteenth", "context.eighth", "fusion", "head"]


def counts_of(widths):
    """Channels by name of the group."""
    flat = [*widths.stem, *(n for modules in widths.stages for blocks in modules for n in blocks),
            *widths.context, widths.fusion, widths.head]
    return dict(zip(group_names(widths), flat))


def widths_with(counts, like):
    """Widths of the given counts; squeeze and the number of modules as in `like`."""
    left = iter(counts[name] for name in group_names(like))
    stem = (next(left), next(left))
    stages = tuple(tuple(tuple(next(left) for _ in range(4)) for _ in modules)
                   for modules in like.stages)
    return Widths(stem, stages, (next(left), next(left), next(left)), next(left), like.squeeze,
                  next(left))


def multiplications(widths, size):
    """Of all convolutions for an image of `size` = (width, height)."""
    def at(share):
        return size[0] * size[1] / share**2

    first, second = widths.stem
    total = at(2) * 27 * first + at(4) * 9 * first * second
    channels, ends = second, []
    for share, modules in zip((8, 16, 32), widths.stages):
        for i, (a, b, c, d) in enumerate(modules):
            total += at(share / 2 if i == 0 else share) * channels * a
            total += at(share) * 9 * (a * b + b * c + c * d)
            channels = a + b + c + d
        ends.append(channels)
    deep, sixteenth, eighth = widths.context
    total += at(32) * 9 * ends[2] * deep
    total += at(16) * 9 * (ends[1] + deep) * sixteenth + at(8) * 9 * sixteenth * eighth
    return total + at(8) * ((ends[0] + eighth) * widths.fusion + 9 * widths.fusion * widths.head)


def _watch(network, names, keep):
    """Hooks that hand the tensor of each group to keep(name, tensor)."""
    modules = dict(network.named_modules())
    readers = {"context.deep": "context.head5", "context.sixteenth": "context.head4"}
    writers = {"context.eighth": "context.head4", "fusion": "ffm", "head": "head.conv"}

    def before(name):
        return lambda _, inputs: keep(name, inputs[0])

    def after(name):
        return lambda _, inputs, output: keep(name, output)

    return [modules[readers[name]].register_forward_pre_hook(before(name)) if name in readers
            else modules[writers.get(name, name)].register_forward_hook(after(name))
            for name in names]


def moments(network, batches):
    """{group: (S, G)}: second moments of values and of gradients, [channels, channels].

    G is summed over the places of an image. The gradients are those of the margin between the
    classes in places where it is in doubt, each with a random sign, so that G is the Fisher
    information of the group.
    """
    names, held, sums, images = group_names(network.widths), {}, {}, 0

    def keep(name, tensor):
        tensor.retain_grad()
        held[name] = tensor

    handles = _watch(network, names, keep)
    generator = torch.Generator().manual_seed(0)
    for batch in batches:
        logits = network(batch.requires_grad_())
        margins = logits[:, 1:].logsumexp(1) - logits[:, 0]
        chance = torch.sigmoid(margins.detach())
        signs = torch.randint(0, 2, margins.shape, generator=generator) * 2 - 1
        (margins * signs * (chance * (1 - chance) + 0.01).sqrt()).sum().backward()
        for name, tensor in held.items():
            values, slopes = (t.detach().transpose(0, 1).flatten(1).double()
                              for t in (tensor, tensor.grad))
            mine = sums.setdefault(name, [0, 0, 0])
            mine[0] = mine[0] + values @ values.T
            mine[1] = mine[1] + slopes @ slopes.T
            mine[2] += values.shape[1]
        images += len(batch)
    for handle in handles:
        handle.remove()
    return {name: (s.numpy() / count, g.numpy() / images) for name, (s, g, count) in sums.items()}


def elimination(values, slopes):
    """Order in which channels go, cheapest first, and the error after each: two arrays.

    values, slopes: S and G of a group.
    """
    count = len(values)
    inverse = np.linalg.inv(values + RIDGE * np.trace(values) / count * np.eye(count))
    regression, kept, order, errors = np.eye(count), np.arange(count), [], []
    error = 0.0
    while len(kept) > 1:
        rise = np.einsum("ck,ck->k", regression, slopes @ regression) / np.diag(inverse)
        worst = int(np.argmin(rise))
        error += float(rise[worst])
        order.append(int(kept[worst]))
        errors.append(error)
        share = inverse[worst] / inverse[worst, worst]
        regression = np.delete(regression - np.outer(regression[:, worst], share), worst, 1)
        inverse = np.delete(np.delete(inverse - np.outer(inverse[:, worst], share), worst, 0),
                            worst, 1)
        kept = np.delete(kept, worst)
    return np.array(order), np.array(errors)


def regression(values, kept):
    """[channels, kept]: all channels of a group from the kept ones by least squares."""
    part = values[np.ix_(kept, kept)]
    part = part + RIDGE * np.trace(part) / len(kept) * np.eye(len(kept))
    matrix = np.linalg.solve(part, values[kept]).T
    matrix[kept] = np.eye(len(kept))
    return matrix


def spend(widths, errors, size, budget):
    """Widths within `budget` multiplications at `size`: the cheapest chunks go, one by one.

    errors: {group: error after removing 1, 2, ... channels}.
    """
    counts, full = counts_of(widths), counts_of(widths)

    def error(name, count):
        gone = full[name] - count
        return errors[name][gone - 1] if gone else 0.0

    total = multiplications(widths, size)
    while total > budget:
        options = []
        for name, count in counts.items():
            fewer = count - CHUNK
            if fewer < max(CHUNK, LEAST_SHARE * full[name]):
                continue
            saved = total - multiplications(widths_with(counts | {name: fewer}, widths), size)
            options.append(((error(name, fewer) - error(name, count)) / saved, name, saved))
        if not options:
            raise ValueError(f"{budget / 1e6:.0f} million multiplications are too few: no layer "
                             f"may lose more than {100 * (1 - LEAST_SHARE):.0f} % of its channels")
        _, name, saved = min(options)
        counts[name] -= CHUNK
        total -= saved
    return widths_with(counts, widths)
