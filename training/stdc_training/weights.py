"""The weights file that the C++ program reads: tensors, their types and the metadata."""

import json

import numpy as np
import torch

from . import safetensors
from .network import StdcSeg, inference_state
from .widen import widen
from .widths import Widths

FORMAT = safetensors.CHECKED_FORMAT
FORMATS = ("stdc-weights-1", FORMAT)  # the first may lack its checksum
CLASSES = ("background", "person")
MEAN = (0.485, 0.456, 0.406)
STD = (0.229, 0.224, 0.225)


def metadata(network, size, licence, ranges=None, classes=CLASSES, dynamic=None, **notes):
    """The file's metadata. size: (width, height) of the default input; ranges: see calibrate;
    classes: names in the order of the channels; dynamic: those that move, all but the first."""
    dynamic = classes[1:] if dynamic is None else dynamic
    if len(classes) != network.head.classify.out_channels or not set(dynamic) <= set(classes):
        raise ValueError(f"classes {classes}, dynamic {dynamic}: the network tells "
                         f"{network.head.classify.out_channels} classes apart")
    entries = {
        "format": FORMAT,
        "architecture": network.architecture,
        "classes": json.dumps(classes),
        "dynamic_classes": json.dumps(dynamic),
        "input_width": str(size[0]),
        "input_height": str(size[1]),
        "mean": json.dumps(MEAN),
        "std": json.dumps(STD),
        "licence": licence,
    }
    if ranges is not None:
        entries["activation_ranges"] = json.dumps(ranges, sort_keys=True)
    entries.update({name: text for name, text in notes.items() if text})
    return entries


def round_to_half(network):
    """Round the convolutions' weights as `save` does, so that what is calibrated is what will be run."""
    for parameter in network.parameters():
        if parameter.dim() == 4:
            parameter.data = parameter.data.half().float()


def save(path, network, entries, half=True):
    """Write the tensors of inference; with `half` the convolution weights as 16-bit floats."""
    tensors = {}
    for name, tensor in inference_state(network).items():
        array = tensor.detach().float().cpu().numpy()
        tensors[name] = array.astype(np.float16) if half and array.ndim == 4 else array
    safetensors.write(path, tensors, entries)


def load(path):
    """Return (network in evaluation mode, metadata) of a weights file."""
    tensors, entries = safetensors.read(path)
    if entries.get("format") not in FORMATS:
        raise ValueError(f"{path}: format {entries.get('format')!r} instead of {FORMAT!r}")
    network = StdcSeg(
        entries["architecture"],
        classes=len(json.loads(entries["classes"])),
        widths=Widths.of(tensors, entries["architecture"]),
        training_heads=False,
    )
    state = {name: torch.from_numpy(array.astype(np.float32)) for name, array in tensors.items()}
    missing, unknown = network.load_state_dict(state, strict=False)
    missing = [name for name in missing if not name.endswith("num_batches_tracked")]
    if missing or unknown:
        raise ValueError(f"{path}: tensors missing {missing[:3]}, unknown {unknown[:3]}")
    return network.eval(), entries


def load_frozen(path):
    """The network of a weights file for inference alone: normalisation in the convolutions."""
    network = load(path)[0]
    for module in network.modules():
        if hasattr(module, "bn"):
            module.conv = torch.nn.utils.fusion.fuse_conv_bn_eval(module.conv, module.bn)
            module.bn = torch.nn.Identity()
    return network.requires_grad_(False)


def begin_from(path, network):
    """Give a network for training the weights of a file; the heads of training stay as they are.

    The file's network may be narrower: then the given one begins by computing the same (widen).
    """
    trained, entries = load(path)
    own = network.state_dict()
    given = trained.state_dict()
    wrong = [name for name, tensor in given.items()
             if name not in own or any(a < b for a, b in zip(own[name].shape, tensor.shape))]
    if wrong or entries["architecture"] != network.architecture:
        what = wrong[0] if wrong else entries["architecture"]
        raise ValueError(f"{path}: {what} does not fit; give --architecture of the file and "
                         "--channels or --divisor and --head not below its width")
    widen(trained, network)


def widths_of(path):
    """(architecture, Widths) of a weights file."""
    tensors, entries = safetensors.read(path)
    return entries["architecture"], Widths.of(tensors, entries["architecture"])


def normalised(images):
    """uint8 RGB [n, h, w, 3] to float [n, 3, h, w] as the networks take it."""
    values = images.permute(0, 3, 1, 2).float() / 255
    mean = torch.tensor(MEAN, device=values.device).view(1, 3, 1, 1)
    std = torch.tensor(STD, device=values.device).view(1, 3, 1, 1)
    return (values - mean) / std
