"""Masks by PyTorch: python3 -m stdc_training.masks WEIGHTS OUTPUT PICTURE...

Writes OUTPUT/NAME.png for each picture, 255 = dynamic class, at the picture's size: the
reference for what the C++ program makes of the same weights file. --compare FOLDER reads that
program's masks of the same names and prints the share of pixels that differ.
"""

import argparse
import json
from pathlib import Path

import cv2
import numpy as np
import torch

from . import weights
from .network import upsampled


def dynamic_mask(network, metadata, picture):
    """uint8 mask [h, w] of an RGB picture, by way of the file's default size of inference."""
    size = int(metadata["input_width"]), int(metadata["input_height"])
    mode = cv2.INTER_AREA if size[0] < picture.shape[1] else cv2.INTER_LINEAR
    pixels = cv2.resize(picture, size, interpolation=mode)
    with torch.no_grad():
        logits = network(weights.normalised(torch.from_numpy(pixels)[None]))
        classes = upsampled(logits, (size[1], size[0])).argmax(1)[0].numpy()
    names = json.loads(metadata["classes"])
    moving = [names.index(name) for name in json.loads(metadata["dynamic_classes"])]
    mask = np.where(np.isin(classes, moving), 255, 0).astype(np.uint8)
    return cv2.resize(mask, picture.shape[1::-1], interpolation=cv2.INTER_NEAREST)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("weights")
    parser.add_argument("output")
    parser.add_argument("pictures", nargs="+")
    parser.add_argument("--compare", help="folder of other masks of the same names")
    options = parser.parse_args()
    torch.set_num_threads(1)
    network, metadata = weights.load(options.weights)
    Path(options.output).mkdir(parents=True, exist_ok=True)
    for path in map(Path, options.pictures):
        picture = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if picture is None:
            parser.error(f"{path}: cannot be read as a picture")
        mask = dynamic_mask(network, metadata, cv2.cvtColor(picture, cv2.COLOR_BGR2RGB))
        cv2.imwrite(str(Path(options.output) / f"{path.stem}.png"), mask)
        text = f"{path.name}: {(mask > 0).mean():.2%} dynamic"
        if options.compare:
            other = Path(options.compare) / f"{path.stem}.png"
            other = cv2.imread(str(other), cv2.IMREAD_GRAYSCALE)
            text += f", {((other > 127) != (mask > 0)).mean():.4%} differ"
        print(text)


if __name__ == "__main__":
    main()
