"""Checkpoint to weights file: python3 -m stdc_training.export CHECKPOINT DATA OUTPUT.

Takes the averaged weights, calibrates the ranges for int8 on training samples and writes
.safetensors with the metadata that the program reads.
"""

import argparse
import json
from pathlib import Path

import torch

from . import calibrate, safetensors, weights
from .licence import PERMISSIVE, licence_of
from .network import TRAINING_ONLY, StdcSeg
from .samples import Samples
from .widths import Widths

CALIBRATION_IMAGES = 64


def from_checkpoint(path):
    """(network with the averaged weights, checkpoint) of a file written by stdc_training.train."""
    state = torch.load(path, map_location="cpu")
    options = state["options"]
    architecture = options["architecture"]
    network = StdcSeg(architecture, classes=len(state["average"]["head.classify.bias"]),
                      widths=Widths.of(state["average"], architecture),
                      training_heads=False)
    kept = {name: tensor for name, tensor in state["average"].items()
            if not name.startswith(TRAINING_ONLY)}
    network.load_state_dict(kept)
    return network.eval(), state


def sources_of(used):
    """Names of all that a training with these options saw; None: everything that is packed."""
    sources = used.get("sources")
    if sources is None:
        return None
    return [*sources, "rendered"] if used.get("rendered") else sources


def taught_by_all(used):
    """Whether a teacher, or the weights that the training began with, may have seen every source."""
    if used.get("teacher"):
        return True
    begun_with = used.get("start_from")
    if not begun_with:
        return False
    if not Path(begun_with).exists():
        return True  # nobody can tell any more
    licence = safetensors.read(begun_with)[1].get("licence", "")
    return not licence.startswith(PERMISSIVE)


def calibration_batches(folder, size, used, batch=8):
    """Normalised training samples at the size of inference, of what the training saw."""
    samples = Samples(folder, size, CALIBRATION_IMAGES, seed=99, sources=used.get("sources"),
                      rendered=used.get("rendered") if used.get("sources") else None)
    for begin in range(0, CALIBRATION_IMAGES, batch):
        pixels = [samples[i][0] for i in range(begin, begin + batch)]
        yield weights.normalised(torch.stack(pixels))


def names(text):
    """"person,animal" as a tuple."""
    return tuple(name.strip() for name in text.split(",") if name.strip())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("checkpoint")
    parser.add_argument("data", help="folder of packed training data, for the calibration")
    parser.add_argument("output")
    parser.add_argument("--size", type=int, nargs=2, default=(256, 192), metavar=("W", "H"),
                        help="default size of inference, multiples of 32")
    parser.add_argument("--classes", type=names, default=weights.CLASSES, metavar="NAME,...",
                        help="of the labels 0, 1, ...; default: background,person")
    parser.add_argument("--dynamic", type=names, metavar="NAME,...",
                        help="those that move by themselves; default: all but the first")
    parser.add_argument("--scores", default="", help="text about scores for the metadata")
    parser.add_argument("--float32", action="store_true", help="keep all weights in 32 bit")
    options = parser.parse_args()
    if options.size[0] % 32 or options.size[1] % 32:
        parser.error(f"--size {options.size}: give multiples of 32")
    network, state = from_checkpoint(options.checkpoint)
    if not options.float32:
        weights.round_to_half(network)
    used = state["options"]
    ranges = calibrate.activation_ranges(network,
                                         calibration_batches(options.data, options.size, used))
    trained = f"{state['images']} images seen, last at {used['width']}x{used['height']}"
    entries = weights.metadata(network, options.size,
                               licence_of(sources_of(used), taught_by_all(used)), ranges,
                               options.classes, options.dynamic, version="1", trained=trained,
                               scores=options.scores)
    weights.save(options.output, network, entries, half=not options.float32)
    count = sum(t.size for t in safetensors.read(options.output)[0].values())
    print(json.dumps({"file": options.output, "parameters": count, "trained": trained}))


if __name__ == "__main__":
    main()
