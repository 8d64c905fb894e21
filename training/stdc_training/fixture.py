"""Small networks with random weights and their outputs, for the tests of the C++ reader.

python3 -m stdc_training.fixture FOLDER writes tiny.safetensors (STDC1-Seg, an eighth of the
channels), tiny2.safetensors (STDC2-Seg), tiny4.safetensors (STDC1-Seg that tells four
classes apart) and, for each, NAME_reference.safetensors with the
normalised image "input" [3, h, w] and PyTorch's "logits" [classes, h/8, w/8] in 32-bit floats.
"""

import argparse
import os

import torch
from torch import nn

from . import calibrate, safetensors, weights
from .network import StdcSeg

DIVISOR = 8
HEIGHT, WIDTH = 64, 96


CLASSES = ("background", "person", "animal", "vehicle")


def random_network(architecture, seed, classes=2):
    """A network whose batch normalisations do something and whose features stay near 1."""
    torch.manual_seed(seed)
    network = StdcSeg(architecture, classes, divisor=DIVISOR, head=8, training_heads=False)
    for module in network.modules():
        if isinstance(module, nn.BatchNorm2d):
            nn.init.uniform_(module.weight, 0.5, 1.5)
            nn.init.normal_(module.bias, 0.1, 0.2)
            nn.init.normal_(module.running_mean, 0, 0.2)
            nn.init.uniform_(module.running_var, 0.5, 2)
    nn.init.normal_(network.head.classify.bias, 0, 0.5)
    weights.round_to_half(network)
    return network.eval()


def smooth_image(seed):
    """Random uint8 RGB [1, h, w, 3] with structure at several scales, as photos have."""
    generator = torch.Generator().manual_seed(seed)
    image = torch.zeros(1, 3, HEIGHT, WIDTH)
    for step in (2, 8, 32):
        noise = torch.randn(1, 3, HEIGHT // step, WIDTH // step, generator=generator)
        image += nn.functional.interpolate(noise, size=(HEIGHT, WIDTH), mode="bicubic")
    return (image * 50 + 120).clamp(0, 255).byte().permute(0, 2, 3, 1)


def write_fixture(folder, name, architecture, seed, classes=2):
    network = random_network(architecture, seed, classes)
    images = weights.normalised(smooth_image(seed))
    with torch.no_grad():
        first = network(images)  # then shifted, so that much of the picture is of each class
        for k in range(1, classes):
            network.head.classify.bias[k] -= (first[:, k] - first[:, 0]).median()
        logits = network(images)
    ranges = calibrate.activation_ranges(network, [images])
    entries = weights.metadata(network, (WIDTH, HEIGHT), "Apache-2.0 (random numbers)", ranges,
                               CLASSES[:classes])
    weights.save(os.path.join(folder, f"{name}.safetensors"), network, entries)
    safetensors.write(
        os.path.join(folder, f"{name}_reference.safetensors"),
        {"input": images[0].numpy(), "logits": logits[0].numpy()},
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    folder = parser.parse_args().folder
    os.makedirs(folder, exist_ok=True)
    write_fixture(folder, "tiny", "STDC1-Seg", 1)
    write_fixture(folder, "tiny2", "STDC2-Seg", 2)
    write_fixture(folder, "tiny4", "STDC1-Seg", 3, classes=4)


if __name__ == "__main__":
    main()
