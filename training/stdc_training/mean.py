"""The mean of several weights files: python3 -m stdc_training.mean DATA OUTPUT FILE FILE... [--shares S...].

Networks that were trained on from the same weights lie in one valley; their mean is often better than each of
them (Wortsman et al., 'Model soups', ICML 2022). Batch normalisation's means and variances are measured anew
on training samples (Izmailov et al., 'Averaging Weights Leads to Wider Optima and Better Generalization',
UAI 2018), and so are the ranges for int8.
"""

import argparse
import json

import torch

from . import calibrate, safetensors, weights
from .export import calibration_batches
from .licence import PERMISSIVE
from .samples import Samples

KEPT = ("classes", "dynamic_classes", "architecture")


def mean_of(networks, shares):
    """A network with the weighted mean of all numbers; shares are scaled to a sum of 1."""
    if len(networks) != len(shares):
        raise ValueError(f"{len(shares)} shares for {len(networks)} files")
    total = sum(shares)
    if total <= 0 or min(shares) < 0:
        raise ValueError(f"shares {shares}: give numbers of 0 or more, one of them greater")
    states = [network.state_dict() for network in networks]
    shapes = [{name: tensor.shape for name, tensor in state.items()} for state in states]
    if any(other != shapes[0] for other in shapes):
        raise ValueError("the files hold networks of different channels")
    average = {}
    for name, tensor in states[0].items():
        average[name] = tensor.clone()
        if tensor.is_floating_point():
            average[name] = sum(share / total * state[name] for share, state in zip(shares, states))
    networks[0].load_state_dict(average)
    return networks[0]


def measure_statistics(network, samples, batch=16):
    """Batch normalisation's means and variances over all samples, as they are used after training."""
    loader = torch.utils.data.DataLoader(samples, batch_size=batch)
    torch.optim.swa_utils.update_bn((weights.normalised(pixels) for pixels, _ in loader), network)
    return network.eval()


def licence_of_mean(entries):
    """The first licence that is not permissive, since the mean holds something of every file."""
    licences = [entry.get("licence", "") for entry in entries]
    return next((text for text in licences if not text.startswith(PERMISSIVE)), licences[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", help="folder of packed training data")
    parser.add_argument("output")
    parser.add_argument("files", nargs="+", help="weights files of the same channels")
    parser.add_argument("--shares", type=float, nargs="+", metavar="S", help="one for each file; default: equal")
    parser.add_argument("--statistics", type=int, default=640, metavar="N",
                        help="samples that batch normalisation is measured on; 0: the mean of the files'")
    parser.add_argument("--camera", type=float, default=0.4, metavar="SHARE",
                        help="share of those that look like an RGB-D camera's")
    parser.add_argument("--sources", nargs="+", metavar="NAME",
                        help="measure on these kinds of photos and scenes alone, see stdc_training.train")
    parser.add_argument("--size", type=int, nargs=2, metavar=("W", "H"),
                        help="default size of inference; default: that of the first file")
    options = parser.parse_args()
    loaded = [weights.load(file) for file in options.files]
    entries = [entry for _, entry in loaded]
    for file, entry in zip(options.files, entries):
        for name in KEPT:
            if entry[name] != entries[0][name]:
                parser.error(f"{file}: {name} {entry[name]}, but {entries[0][name]} in {options.files[0]}")
    size = tuple(options.size or (int(entries[0]["input_width"]), int(entries[0]["input_height"])))
    try:
        network = mean_of([network for network, _ in loaded], options.shares or [1] * len(loaded))
    except ValueError as error:
        parser.error(str(error))
    if options.statistics:
        measure_statistics(network, Samples(options.data, size, options.statistics, seed=98, strength=0.8,
                                            heights=(0.17, 4), camera=options.camera, sources=options.sources))
    weights.round_to_half(network)
    ranges = calibrate.activation_ranges(network, calibration_batches(options.data, size, {"sources": options.sources}))
    result = weights.metadata(network, size, licence_of_mean(entries), ranges,
                              tuple(json.loads(entries[0]["classes"])),
                              tuple(json.loads(entries[0]["dynamic_classes"])), version="1",
                              trained="mean of: " + "; ".join(entry.get("trained", "?") for entry in entries))
    weights.save(options.output, network, result)
    count = sum(tensor.size for tensor in safetensors.read(options.output)[0].values())
    print(json.dumps({"file": options.output, "parameters": count}))


if __name__ == "__main__":
    main()
