"""Endless training samples: photos, composed rooms, empty rooms, rendered frames.

Sample number i is made from the seed and i alone, so that a resumed training sees what an
uninterrupted one would have seen, whatever the number of loading processes.
"""

import cv2
import numpy as np
import torch

from . import people
from .compose import compose, hide
from .photometric import blur, distort
from .rgbd_camera import rgbd_camera
from .views import person_view, scene_view, warp, whole_view

# Shares of the kinds of samples; rooms (all but photos) are over half of what the network sees.
SHARES = {"photo": 0.44, "composed": 0.38, "empty": 0.18}
SHARES_WITH_RENDERED = {"photo": 0.38, "composed": 0.32, "empty": 0.23, "render": 0.07}
# Of the pictures without people, how many are photos of other places than rooms, with animals and all.
ELSEWHERE, ELSEWHERE_SHARE = "elsewhere", 0.4
# Photos by kind. The street photos are many but all alike, so they count less than their number.
PHOTO_SHARES = {"ccp_masked": 0.25, "ccp_teacher": 0.15, "lspet_teacher": 0.28,
                "voc_teacher": 0.2, "human291_masked": 0.12}
CUTOUT_SHARES = {"ccp_masked": 0.45, "ccp_teacher": 0.2, "lspet_teacher": 0.2,
                 "human291_masked": 0.15, "rendered": 0.15}
# Of the people put into rooms, how many are seen without their heads; they stand above desks so.
DOWNWARD_SHARE = 0.3
# How many of them are seen from lower than 1.3 m, down to the height of a knee.
LOW_SHARE = 0.2
# How many composed rooms have furniture in front of the people.
HIDDEN_SHARE = 0.4
# Of the photos, how many are seen whole.
WHOLE_SHARE = 0.2
# A person smaller than this (share of the packed image's height) makes a poor cutout.
LEAST_CUTOUT_HEIGHT = 0.35


def source_of(entry):
    """Name of the source of an entry of the index: its kind, for an empty room the scene."""
    kind, name = entry["kind"], entry["name"]
    return name.split("_")[0] if kind == people.EMPTY else kind


class Samples(torch.utils.data.Dataset):
    """Sample i: (uint8 RGB [h, w, 3], uint8 label [h, w]) at size (width, height).

    strength: of the changes of colour and sharpness, 0..1; heights: of people, in frame heights;
    camera: share of the samples that look like an RGB-D camera's; sources: names of the kinds of
    photos and of the scenes that are used, all of them without it; empty: share of the samples
    without people, instead of the usual one.
    """

    def __init__(self, folder, size, count, seed=0, rendered=None, strength=1.0,
                 heights=(0.35, 3.0), camera=0.0, sources=None, empty=None):
        self._packed = people.Packed(folder, "train")
        self._frames = people.Packed(folder, rendered) if rendered else None
        self._size, self._count, self._seed = size, count, seed
        self._strength, self._heights, self._camera = strength, heights, camera
        self._kinds, self._cutouts, self._scenes = {}, {}, {}
        for i, entry in enumerate(self._packed.index):
            if sources is None or source_of(entry) in sources:
                self._add_photo(i, entry)
        for i, entry in enumerate(self._frames.index if rendered else ()):
            if entry["box"] is None:
                self._add_scene("rendered", self._frames, i)
            else:
                self._add_cutout(self._frames, i, entry)
        if not (self._cutouts and self._scenes):
            raise ValueError(f"--sources {' '.join(sources or ())}: without people to cut out and "
                             "scenes without people no samples can be made")
        self._shares = self._shares_of_kinds(empty)

    def _shares_of_kinds(self, empty):
        """Shares of the kinds of samples that can be made; without photos of people rendered frames
        take their place."""
        shares = dict(SHARES_WITH_RENDERED if self._frames else SHARES)
        if not any(kind in PHOTO_SHARES for kind in self._kinds):
            photos = shares.pop("photo")
            if self._frames:
                shares["render"] += photos
        if empty is not None:
            others = sum(shares.values()) - shares["empty"]
            shares["empty"] = others * empty / (1 - empty)
        total = sum(shares.values())
        return {kind: share / total for kind, share in shares.items()}

    def _add_photo(self, i, entry):
        self._kinds.setdefault(entry["kind"], []).append(i)
        if entry["kind"] == people.EMPTY:
            self._add_scene(source_of(entry), self._packed, i)
        elif entry["box"] is None:
            self._add_scene(ELSEWHERE, self._packed, i)
        elif entry["kind"] in CUTOUT_SHARES:
            self._add_cutout(self._packed, i, entry)

    def _add_scene(self, scene, packed, i):
        self._scenes.setdefault(scene, []).append((packed, i))

    def _add_cutout(self, packed, i, entry):
        if entry["box"][3] - entry["box"][1] >= LEAST_CUTOUT_HEIGHT * entry["shape"][0]:
            self._cutouts.setdefault(entry["kind"], []).append((packed, i))

    def __len__(self):
        return self._count

    def __getitem__(self, i):
        seen, label, _, _ = self.with_clean(i)
        return seen, label

    def with_clean(self, i):
        """Sample i as the network sees it, its label, the image before colours and sharpness were
        changed, and 1 where the label is exact, 0 for photos whose labels come from a network."""
        cv2.setNumThreads(1)
        rng = np.random.default_rng([self._seed, i])
        kind = rng.choice(list(self._shares), p=list(self._shares.values()))
        clean, label, exact = getattr(self, f"_{kind}")(rng)
        if self._camera and rng.random() < self._camera:
            seen = rgbd_camera(rng, blur(rng, clean) if rng.random() < 0.3 else clean)
        else:
            seen = distort(rng, clean, self._strength)
        label = torch.from_numpy(np.ascontiguousarray(label))
        return torch.from_numpy(seen), label, torch.from_numpy(clean), exact

    def _pick(self, rng, groups, shares):
        there = [kind for kind in shares if kind in groups]
        chances = np.array([shares[kind] for kind in there])
        kind = rng.choice(there, p=chances / chances.sum())
        return groups[kind][rng.integers(len(groups[kind]))]

    def _photo(self, rng):
        i = self._pick(rng, self._kinds, PHOTO_SHARES)
        entry = self._packed.index[i]
        exact = int(not entry["kind"].endswith("_teacher"))
        if rng.random() < WHOLE_SHARE:  # as a program sees a photo that it fits into its input
            return *warp(self._packed[i], whole_view(rng, entry, self._size), self._size,
                         cv2.BORDER_CONSTANT, int(rng.integers(256))), exact
        by_person = entry["box"] is not None and rng.random() < 0.75
        return *warp(self._packed[i], self._view(rng, entry, by_person), self._size), exact

    def _view(self, rng, entry, by_person):
        if by_person:
            return person_view(rng, entry, self._size, self._heights)
        return scene_view(rng, entry, self._size)

    def _room(self, rng, scene=None):
        scene = scene or str(rng.choice(list(self._scenes)))  # each alike, however many its frames
        packed, i = self._scenes[scene][rng.integers(len(self._scenes[scene]))]
        return warp(packed[i], scene_view(rng, packed.index[i], self._size), self._size)

    def _empty(self, rng):
        elsewhere = ELSEWHERE in self._scenes and rng.random() < ELSEWHERE_SHARE
        return *self._room(rng, ELSEWHERE if elsewhere else None), 1

    def _composed(self, rng):
        frame, _ = self._room(rng)
        count = rng.choice([1, 2, 3], p=[0.6, 0.28, 0.12])
        picks = [self._pick(rng, self._cutouts, CUTOUT_SHARES) for _ in range(count)]
        cutouts = [(packed.index[i], packed[i]) for packed, i in picks]
        image, label = compose(rng, frame, cutouts, self._size, self._heights, DOWNWARD_SHARE,
                               LOW_SHARE)
        if rng.random() < HIDDEN_SHARE:
            image, label = hide(rng, image, label, self._room(rng)[0])
        return image, label, 1

    def _render(self, rng):
        i = int(rng.integers(len(self._frames)))
        entry = self._frames.index[i]
        by_person = entry["box"] is not None and rng.random() < 0.5
        return *warp(self._frames[i], self._view(rng, entry, by_person), self._size), 1


class TaughtSamples(Samples):
    """Samples for a student of another network: (image, label, clean image, label exact or not)."""

    def __getitem__(self, i):
        return self.with_clean(i)
