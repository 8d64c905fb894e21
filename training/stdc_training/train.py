"""Train a network: python3 -m stdc_training.train DATA RUN [options].

DATA is the folder of `stdc_training.pack`. RUN receives last.pt and best.pt (checkpoints),
log.csv (losses) and scores.csv (validation). Started again with the same RUN it goes on from
last.pt; size, batch, learning rate and total may then differ, which is how the picture size
grows in the course of a training. A new RUN may begin from a weights file (--start-from).
"""

import argparse
import csv
import os
import signal
import sys
import time
from pathlib import Path

import torch

from .detail import DetailTarget
from .ema import Average
from .losses import total_loss, without_doubt
from .muon import Muon
from .network import StdcSeg, default_device
from .quick_check import quick_scores, validation_subset
from .samples import Samples, TaughtSamples
from .weights import begin_from, load_frozen, normalised, widths_of
from .widths import MODULES


BETAS = (0.9, 0.99)
OPTIMISERS = {
    "muon": lambda options, groups: Muon(groups, options.rate, betas=BETAS, bf16=options.bf16),
    "adamw": lambda options, groups: torch.optim.AdamW(groups, options.rate, betas=BETAS),
}


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data")
    parser.add_argument("run")
    parser.add_argument("--architecture", choices=sorted(MODULES), default="STDC1-Seg")
    parser.add_argument("--divisor", type=int, default=1, help="narrows all layers by it")
    parser.add_argument("--head", type=int, default=64, help="channels of the heads")
    parser.add_argument("--channels", metavar="WEIGHTS",
                        help="a file of stdc_training.prune: the network has the channels of that, "
                             "instead of --divisor and --head")
    parser.add_argument("--main-only", action="store_true",
                        help="without auxiliary heads and detail guidance: faster, for the "
                             "training of a network that begins with good weights")
    parser.add_argument("--width", type=int, default=224)
    parser.add_argument("--height", type=int, default=160)
    parser.add_argument("--batch", type=int, default=16)
    parser.add_argument("--images", type=int, default=400_000, help="when the schedule ends")
    parser.add_argument("--fall-from", type=int, default=0, metavar="IMAGES",
                        help="where the learning rate begins to fall towards 0 at --images")
    parser.add_argument("--optimiser", choices=OPTIMISERS, default="muon")
    parser.add_argument("--rate", type=float, default=2e-3, help="highest learning rate")
    parser.add_argument("--decay", type=float, default=0.02, help="weight decay")
    parser.add_argument("--warmup", type=int, default=300, help="steps")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--hard-after", type=int, default=0, metavar="IMAGES",
                        help="mine hard pixels only when so many images were seen")
    parser.add_argument("--strength", type=float, default=1.0,
                        help="of changes of colour and sharpness, 0..1")
    parser.add_argument("--heights", type=float, nargs=2, default=(0.35, 3.0),
                        metavar=("LOW", "HIGH"), help="of people, in frame heights")
    parser.add_argument("--camera", type=float, default=0.0, metavar="SHARE",
                        help="of the samples that look like an RGB-D camera's pictures")
    parser.add_argument("--empty", type=float, metavar="SHARE",
                        help="of the samples that show nobody, above 0 and below 1, instead of the "
                             "usual one")
    parser.add_argument("--sources", nargs="+", metavar="NAME",
                        help="use these only: kinds of photos (ccp_masked ...) and scenes of rooms "
                             "(the beginning of their files' names)")
    parser.add_argument("--rendered", help="name of a packed set of rendered frames in DATA")
    parser.add_argument("--start-from", metavar="WEIGHTS",
                        help="weights file that a new training begins with")
    parser.add_argument("--teacher", metavar="WEIGHTS",
                        help="another network, whose probabilities soften the labels; it sees the "
                             "images before their colours and sharpness are changed")
    parser.add_argument("--teacher-share", type=float, default=0.5, help="their weight, 0..1")
    parser.add_argument("--loss-stride", type=int, default=1, metavar="PIXELS",
                        help="squares of so many pixels count as one in the losses")
    parser.add_argument("--outline-weight", type=float, default=1.0, metavar="WEIGHT",
                        help="of pixels near the outlines of people, where hard pixels are not mined")
    parser.add_argument("--bf16", action="store_true",
                        help="mixed precision on a CPU: faster where it has AVX-512 BF16 or AMX")
    parser.add_argument("--loaders", type=int, default=1, help="processes that make samples")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--evaluate-seconds", type=float, default=1200)
    parser.add_argument("--checkpoint-seconds", type=float, default=180)
    options = parser.parse_args(arguments)
    if options.empty is not None and not 0 < options.empty < 1:
        parser.error(f"--empty {options.empty}: above 0 and below 1 is allowed")
    return options


class Trainer:
    """State of a training: network, average, optimiser, images seen, best score."""

    def __init__(self, options):
        torch.manual_seed(options.seed)
        self.options, self.device = options, default_device()
        self.mixed = self.device.type == "cuda" or options.bf16
        widths = widths_of(options.channels)[1] if options.channels else None
        self.network = StdcSeg(options.architecture, divisor=options.divisor, head=options.head,
                               training_heads=not options.main_only, widths=widths)
        if options.start_from:
            begin_from(options.start_from, self.network)
        self.network.to(self.device, memory_format=torch.channels_last)
        self.teacher = None
        if options.teacher:
            self.teacher = load_frozen(options.teacher).to(self.device,
                                                           memory_format=torch.channels_last)
        self.detail = DetailTarget().to(self.device)
        self.average = Average(self.network)
        self.optimiser = OPTIMISERS[options.optimiser](options, self._groups())
        self.scaler = torch.cuda.amp.GradScaler(enabled=self.device.type == "cuda")
        self.images, self.steps, self.warm_from, self.best = 0, 0, 0, 0.0
        self.run = Path(options.run)
        self.run.mkdir(parents=True, exist_ok=True)

    def _groups(self):
        """Convolutions, classifiers (whose few outputs no orthogonal step suits), all else."""
        named = [(n, p) for n, p in self.network.named_parameters() if p.dim() > 1]
        decay = {"weight_decay": self.options.decay}
        others = [p for p in self.network.parameters() if p.dim() <= 1]
        return [{"params": [p for n, p in named if "classify" not in n], "orthogonal": True} | decay,
                {"params": [p for n, p in named if "classify" in n], "orthogonal": False} | decay,
                {"params": others + list(self.detail.parameters()), "orthogonal": False,
                 "weight_decay": 0.0}]

    def rate(self):
        """Warm-up, then the poly schedule with power 0.9 (the paper, sec. 4.1)."""
        warm = min(1.0, (self.steps - self.warm_from + 1) / self.options.warmup)
        begin, end = self.options.fall_from, self.options.images
        left = min(1.0, max(0.0, (end - self.images) / (end - begin)))
        return self.options.rate * warm * left**0.9

    def step(self, pixels, labels, clean=None, exact=None):
        """One optimiser step; returns the losses by name. clean, exact: see TaughtSamples."""
        for group in self.optimiser.param_groups:
            group["lr"] = self.rate()
        self.network.train()
        labels = labels.to(self.device, non_blocking=True).long()
        with torch.autocast(self.device.type, enabled=self.mixed):
            outputs = self.network.forward_training(self._input(pixels))
            with torch.no_grad():
                advice = self.teacher(self._input(clean)) if self.teacher else None
        if self.teacher:
            exact = exact.to(self.device)
            labels = without_doubt(labels, exact, advice)
        loss, parts = total_loss(outputs, labels, self.detail,
                                 self.images >= self.options.hard_after, self.options.loss_stride,
                                 advice, self.options.teacher_share, exact,
                                 self.options.outline_weight)
        self.optimiser.zero_grad(set_to_none=True)
        self.scaler.scale(loss).backward()
        self.scaler.step(self.optimiser)
        self.scaler.update()
        self.average.update(self.network)
        self.images += pixels.shape[0]
        self.steps += 1
        return {name: float(part.detach()) for name, part in parts.items()}

    def _input(self, pixels):
        values = normalised(pixels.to(self.device, non_blocking=True))
        return values.contiguous(memory_format=torch.channels_last)

    def state(self):
        return {"network": self.network.state_dict(), "average": self.average.network.state_dict(),
                "updates": self.average.updates, "detail": self.detail.state_dict(),
                "optimiser": self.optimiser.state_dict(), "scaler": self.scaler.state_dict(),
                "images": self.images, "steps": self.steps, "best": self.best,
                "warm_from": self.warm_from, "options": vars(self.options)}

    def save(self, name):
        """Write a checkpoint whole or not at all."""
        partial = self.run / f"{name}.partial"
        torch.save(self.state(), partial)
        os.replace(partial, self.run / name)

    def resume(self):
        """Go on from last.pt if there is one."""
        path = self.run / "last.pt"
        if not path.exists():
            return
        state = torch.load(path, map_location=self.device)
        self.network.load_state_dict(state["network"])
        self.average.network.load_state_dict(state["average"])
        self.average.updates = state["updates"]
        self.detail.load_state_dict(state["detail"])
        self.scaler.load_state_dict(state["scaler"])
        self.images, self.steps, self.best = state["images"], state["steps"], state["best"]
        if state["options"].get("optimiser") != self.options.optimiser:
            self.warm_from = self.steps  # its moments say nothing to another optimiser
            return
        self.warm_from = state.get("warm_from", 0)
        self.optimiser.load_state_dict(state["optimiser"])
        for group, fresh in zip(self.optimiser.param_groups, self._groups()):
            group["weight_decay"] = fresh["weight_decay"]


def append(path, row):
    """Append a row (dict) to a CSV file, with a heading if the file is new."""
    fresh = not path.exists()
    with open(path, "a", newline="") as file:
        writer = csv.DictWriter(file, row.keys())
        if fresh:
            writer.writeheader()
        writer.writerow(row)


def evaluate(trainer, sets):
    scores = quick_scores(trainer.average.network, sets)
    append(trainer.run / "scores.csv", {"images": trainer.images,
                                        **{k: round(v, 5) for k, v in scores.items()}})
    if scores["total"] > trainer.best:
        trainer.best = scores["total"]
        trainer.save("best.pt")
    trainer.save("last.pt")
    return scores


def progress(trainer, losses, begun, seen):
    """One line: bar, images, images per second, time left, losses; overwritten on a terminal."""
    share = trainer.images / trainer.options.images
    speed = seen / (time.monotonic() - begun)
    left = (trainer.options.images - trainer.images) / max(speed, 1e-9)
    bar = "#" * int(20 * share)
    text = " ".join(f"{name} {value:.3f}" for name, value in losses.items())
    print(f"[{bar:<20}] {trainer.images}/{trainer.options.images} {speed:.1f} img/s "
          f"{left / 60:.0f} min left  rate {trainer.rate():.2g}  {text}",
          end="\r" if sys.stdout.isatty() else "\n", flush=True)


def batches(options, start):
    """Batches of samples from number `start` to the end of the schedule."""
    kind = TaughtSamples if options.teacher else Samples
    samples = kind(options.data, (options.width, options.height), options.images, options.seed,
                   options.rendered, options.strength, options.heights, options.camera,
                   options.sources, options.empty)
    return torch.utils.data.DataLoader(
        samples, options.batch, sampler=range(start, options.images), drop_last=True,
        num_workers=options.loaders, pin_memory=torch.cuda.is_available())


class Stop:
    """Becomes true at the first SIGTERM or SIGINT, so that the training can save itself."""

    def __init__(self):
        self.asked = False
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._ask)

    def _ask(self, *_):
        self.asked = True


def train(trainer, sets, stop):
    """Run to the end of the schedule or until asked to stop; logs, saves and validates."""
    options = trainer.options
    begun = shown = saved = evaluated = time.monotonic()
    first, sums, count = trainer.images, {}, 0
    for batch in batches(options, trainer.images):
        losses = trainer.step(*batch)
        sums = {name: sums.get(name, 0) + value for name, value in losses.items()}
        count += 1
        now = time.monotonic()
        if now - shown > 15:
            means = {name: value / count for name, value in sums.items()}
            append(trainer.run / "log.csv", {
                "images": trainer.images, "seconds": round(now - begun, 1), "rate": trainer.rate(),
                **{name: round(value, 5) for name, value in means.items()}})
            progress(trainer, means, begun, trainer.images - first)
            shown, sums, count = now, {}, 0
        if stop.asked or now - saved > options.checkpoint_seconds:
            trainer.save("last.pt")
            saved = now
        if stop.asked:
            return
        if now - evaluated > options.evaluate_seconds:
            print("validation", evaluate(trainer, sets), flush=True)
            evaluated = time.monotonic()
    print("validation", evaluate(trainer, sets), flush=True)


def main():
    options = parse()
    torch.set_num_threads(options.threads)
    trainer = Trainer(options)
    trainer.resume()
    train(trainer, validation_subset(options.data, (options.width, options.height)), Stop())


if __name__ == "__main__":
    main()
