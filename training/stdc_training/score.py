"""Score a weights file: python3 -m stdc_training.score WEIGHTS DATA [--size 512 384].

DATA holds the packed validation set (`stdc_training.pack --long-side 640`). Prints one line for
each set of the model card; --pictures writes montages of the predictions, worst first.
"""

import argparse
from pathlib import Path

import cv2
import numpy as np
import torch

from . import evaluation_sets, metrics, people, weights
from .predict import person_maps


def validation_sets(packed, size):
    """All validation sets by name, as lists of (image, label)."""
    sets = {"photos with own masks": evaluation_sets.photos(
        packed, ("ccp_masked", "human291_masked"), size)}
    for kind in people.KINDS:
        sets[kind] = evaluation_sets.photos(packed, (kind,), size)
    sets["composed rooms"] = evaluation_sets.composed(packed, size, 120)
    sets["turned rooms"] = evaluation_sets.turned(sets["composed rooms"])
    sets["close-ups"] = evaluation_sets.close_ups(packed, size, 120)
    sets["empty rooms"] = evaluation_sets.without_people(packed, size, True)
    sets["other places without people"] = evaluation_sets.without_people(packed, size, False)
    return sets


def montage(pairs, maps, columns=8, rows=6, height=144):
    """RGB picture of the worst predictions: red found, green missed, blue wrongly found."""
    order = np.argsort([metrics.scores(m, label)["iou"] for m, (_, label) in zip(maps, pairs)])
    tiles = []
    for i in order[np.linspace(0, len(order) - 1, min(columns * rows, len(order))).astype(int)]:
        image, label = pairs[i]
        picture = image.astype(np.float32)
        for channel, area in ((0, maps[i] & (label == 1)), (1, ~maps[i] & (label == 1)),
                              (2, maps[i] & (label == 0))):
            picture[area] = picture[area] * 0.55
            picture[area, channel] += 110
        width = round(height * image.shape[1] / image.shape[0])
        tiles.append(cv2.resize(np.clip(picture, 0, 255).astype(np.uint8), (width, height),
                                interpolation=cv2.INTER_AREA))
    tiles += [np.zeros_like(tiles[0])] * (-len(tiles) % columns)
    return np.vstack([np.hstack(tiles[i:i + columns]) for i in range(0, len(tiles), columns)])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("weights")
    parser.add_argument("data")
    parser.add_argument("--size", type=int, nargs=2, default=(512, 384), metavar=("W", "H"))
    parser.add_argument("--pictures", help="folder for montages")
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    torch.set_num_threads(options.threads)
    network, _ = weights.load(options.weights)
    packed = people.Packed(options.data, "validation")
    print("| set | pictures | IoU | precision | recall | boundary F | wrongly person |")
    print("|---|---|---|---|---|---|---|")
    for name, pairs in validation_sets(packed, tuple(options.size)).items():
        maps = person_maps(network, [image for image, _ in pairs])
        s = metrics.mean_scores(maps, [label for _, label in pairs])
        shown = ("iou", "precision", "recall", "boundary_f")
        people_seen = any((label == 1).any() for _, label in pairs)
        columns = [f"{s[key]:.3f}" if people_seen else "-" for key in shown]
        columns.append(f"{100 * s['wrong_share']:.2f} %")
        print(f"| {name} | {len(pairs)} | {' | '.join(columns)} |", flush=True)
        if options.pictures:
            Path(options.pictures).mkdir(parents=True, exist_ok=True)
            picture = cv2.cvtColor(montage(pairs, maps), cv2.COLOR_RGB2BGR)
            cv2.imwrite(str(Path(options.pictures) / f"{name.replace(' ', '_')}.png"), picture)


if __name__ == "__main__":
    main()
