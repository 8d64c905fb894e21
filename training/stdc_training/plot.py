"""Plot the log of a training: python3 -m stdc_training.plot RUN OUTPUT.png (needs matplotlib)."""

import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (the backend has to be chosen first)


def columns(path):
    """{heading: [values]} of a CSV file of numbers."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]} if rows else {}


def smoothed(values, window=15):
    """Running mean over the last `window` values."""
    return [sum(part) / len(part) for part in
            (values[max(0, i + 1 - window):i + 1] for i in range(len(values)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run")
    parser.add_argument("output")
    options = parser.parse_args()
    log = columns(Path(options.run) / "log.csv")
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4), constrained_layout=True)
    for name in ("main", "context8", "context16", "detail"):
        left.plot(log["images"], smoothed(log[name]), label=name)
    left.set(title="loss", xlabel="images seen")
    left.legend()
    scores = Path(options.run) / "scores.csv"
    if scores.exists():
        table = columns(scores)
        for name in ("photos", "hard", "composed"):
            right.plot(table["images"], table[name], marker="o", markersize=3, label=name)
        right.plot(table["images"], [10 * v for v in table["empty"]], "--",
                   label="empty rooms: 10 x share called person")
    right.set(title="validation subsets, at the training's size: IoU", xlabel="images seen",
              ylim=(0, 1))
    right.grid(alpha=0.3)
    right.legend()
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
