"""Labels where views agree: python3 -m stdc_training.agree OUTPUT PICTURE... --weights FILE...

For pictures that nobody has labelled. Each network sees each picture at several sizes, mirrored
and not; OUTPUT/label/NAME.png is 1 where all say person, 0 where none does, 255 between, and
OUTPUT/image has the pictures, so that the program can be scored on them:
stdc-slam segment OUTPUT/image --output MASKS --score OUTPUT/label --truth labels. Look at
OUTPUT/sheets first: what all networks get wrong, these labels get wrong too, and they flatter a
network that made them.
"""

import argparse
import shutil
from pathlib import Path

import cv2
import numpy as np
import torch

from . import weights
from .network import upsampled

SIZES = ((384, 288), (512, 384), (640, 480))
MARGIN = 0.1  # by how much a view's probability has to be over or under a half


def chances(network, picture, sizes=SIZES):
    """Probabilities of a person [views, h, w] for a uint8 RGB picture."""
    found = []
    for size in sizes:
        mode = cv2.INTER_AREA if size[0] < picture.shape[1] else cv2.INTER_LINEAR
        pixels = torch.from_numpy(cv2.resize(picture, size, interpolation=mode))
        views = weights.normalised(torch.stack([pixels, pixels.flip(1)]))
        with torch.no_grad():
            logits = upsampled(network(views).float(), picture.shape[:2])
        chance = torch.sigmoid(logits[:, 1] - logits[:, 0])
        found += [chance[0], chance[1].flip(1)]
    return torch.stack(found).numpy()


def agreed(views, margin=MARGIN):
    """uint8 label [h, w] of the probabilities [views, h, w]: 0, 1, or 255 without agreement."""
    label = np.full(views.shape[1:], 255, np.uint8)
    label[views.max(0) < 0.5 - margin] = 0
    label[views.min(0) > 0.5 + margin] = 1
    return label


def sheet(picture, label, width=320):
    """RGB picture with what the label calls a person in red and what it does not know in blue."""
    shown = picture.astype(np.float32)
    for value, colour in ((1, (255, 0, 0)), (255, (0, 0, 255))):
        shown[label == value] = 0.6 * shown[label == value] + 0.4 * np.array(colour)
    height = round(width * picture.shape[0] / picture.shape[1])
    return cv2.resize(shown.astype(np.uint8), (width, height), interpolation=cv2.INTER_AREA)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("output")
    parser.add_argument("pictures", nargs="+")
    parser.add_argument("--weights", nargs="+", required=True)
    options = parser.parse_args()
    torch.set_num_threads(1)
    networks = [weights.load_frozen(path) for path in options.weights]
    for part in ("image", "label", "sheets"):
        (Path(options.output) / part).mkdir(parents=True, exist_ok=True)
    for path in map(Path, options.pictures):
        picture = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if picture is None:
            parser.error(f"{path}: cannot be read as a picture")
        shutil.copy(path, Path(options.output) / "image")
        picture = cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)
        label = agreed(np.concatenate([chances(network, picture) for network in networks]))
        cv2.imwrite(str(Path(options.output) / "label" / f"{path.stem}.png"), label)
        cv2.imwrite(str(Path(options.output) / "sheets" / f"{path.stem}.jpg"),
                    cv2.cvtColor(sheet(picture, label), cv2.COLOR_RGB2BGR))
        print(f"{path.name}: {(label == 1).mean():.1%} person, {(label == 255).mean():.1%} unknown")


if __name__ == "__main__":
    main()
