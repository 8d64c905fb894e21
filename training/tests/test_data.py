"""Views, composition, samples and the validation list."""

from . import with_torch  # noqa: F401  # isort: skip

import json
import shutil
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import numpy as np
import torch

from stdc_training import evaluation_sets, people, views
from stdc_training.compose import compose
from stdc_training.rgbd_camera import _mosaic, rgbd_camera
from stdc_training.samples import Samples, TaughtSamples, source_of

from .made_up import write_packed


class ViewsTest(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(1)
        self.image = rng.integers(0, 255, (48, 64, 4), dtype=np.uint8)

    def test_identity(self):
        matrix = views.affine((31.5, 23.5), 48, (64, 48))
        colour, label = views.warp(self.image, matrix, (64, 48))
        np.testing.assert_array_equal(colour, self.image[..., :3])
        np.testing.assert_array_equal(label, self.image[..., 3])

    def test_mirror(self):
        matrix = views.affine((31.5, 23.5), 48, (64, 48), mirror=True)
        _, label = views.warp(self.image, matrix, (64, 48))
        np.testing.assert_array_equal(label, self.image[:, ::-1, 3])

    def test_scale(self):
        matrix = views.affine((31.5, 23.5), 24, (64, 48))
        np.testing.assert_allclose(matrix[:, :2], np.eye(2) / 2)

    def test_person_views_show_people_at_many_sizes(self):
        rng = np.random.default_rng(2)
        entry = {"box": [20, 5, 40, 45], "shape": [48, 64]}
        image = np.zeros((48, 64, 4), np.uint8)
        image[5:45, 20:40, 3] = 1
        shares = [views.warp(image, views.person_view(rng, entry, (64, 48)), (64, 48))[1].mean()
                  for _ in range(200)]
        self.assertGreater(np.mean(np.array(shares) > 0), 0.9)
        self.assertLess(min(shares), 0.2)
        self.assertGreater(max(shares), 0.7)


class CameraTest(unittest.TestCase):
    def test_it_is_a_camera_picture_of_the_same(self):
        rng = np.random.default_rng(4)
        ramp = np.tile(np.linspace(0, 255, 64), (48, 1))
        image = np.dstack([ramp, ramp[:, ::-1], np.full_like(ramp, 90)]).astype(np.uint8)
        differences = []
        for _ in range(20):
            found = rgbd_camera(rng, image)
            self.assertEqual((found.shape, found.dtype), (image.shape, np.uint8))
            differences.append(np.abs(found.astype(float) - image).mean())
            ramps = np.corrcoef(found[..., 0].ravel(), image[..., 0].ravel())[0, 1]
            self.assertGreater(ramps, 0.7)
        self.assertGreater(np.mean(differences), 5)

    def test_the_mosaic_keeps_flat_colours(self):
        image = np.full((16, 16, 3), (200, 120, 40), np.uint8)
        rng = np.random.default_rng(4)
        for _ in range(12):
            np.testing.assert_array_equal(_mosaic(rng, image), image)


class DataTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.packed = Path(folder.name) / "packed"
        write_packed(Path(folder.name) / "people", cls.packed)

    def test_validation_is_apart_and_holds_whole_scenes(self):
        names = [{(e["kind"], e["name"]) for e in people.Packed(self.packed, part).index}
                 for part in ("train", "validation")]
        self.assertFalse(names[0] & names[1])
        scenes = {name.split("_")[0] for kind, name in names[1] if kind == people.EMPTY}
        self.assertEqual(scenes, set(people.VALIDATION_SCENES))
        self.assertFalse([n for k, n in names[0] if n.startswith(people.VALIDATION_SCENES)])

    def test_samples_are_the_same_again(self):
        one, two = (Samples(self.packed, (64, 48), 50, seed=7) for _ in range(2))
        for i in (0, 3, 49):
            for a, b in zip(one[i], two[i]):
                self.assertTrue(torch.equal(a, b))
        self.assertFalse(torch.equal(one[0][0], one[1][0]))

    def test_samples_have_the_right_form(self):
        samples = Samples(self.packed, (64, 32), 60)
        values = Counter()
        for i in range(60):
            image, label = samples[i]
            self.assertEqual((tuple(image.shape), image.dtype), ((32, 64, 3), torch.uint8))
            self.assertEqual(tuple(label.shape), (32, 64))
            values.update(label.unique().tolist())
        self.assertLessEqual(set(values), {0, 1, 255})
        self.assertGreater(values[1], 20)  # samples that show a person
        self.assertLess(values[1], 60)  # and some without

    def test_clean_images_for_a_teacher(self):
        taught = TaughtSamples(self.packed, (64, 48), 40, seed=7, camera=0.5)
        plain = Samples(self.packed, (64, 48), 40, seed=7, camera=0.5)
        exact = set()
        for i in range(40):
            seen, label, clean, known = taught[i]
            self.assertTrue(torch.equal(seen, plain[i][0]) and torch.equal(label, plain[i][1]))
            self.assertEqual((clean.shape, clean.dtype), (seen.shape, seen.dtype))
            exact.add(known)
        self.assertEqual(exact, {0, 1})

    def test_sources_can_be_left_out(self):
        sources = ["ccp_masked", "human291_masked", "kitchen"]
        samples = Samples(self.packed, (64, 48), 30, sources=sources)
        used = {source_of(packed.index[i]) for groups in (samples._scenes, samples._cutouts)
                for group in groups.values() for packed, i in group}
        used |= {source_of(samples._packed.index[i]) for group in samples._kinds.values()
                 for i in group}
        self.assertEqual(used, set(sources))
        for i in range(30):
            samples[i]
        with self.assertRaisesRegex(ValueError, "--sources kitchen"):
            Samples(self.packed, (64, 48), 30, sources=["kitchen"])

    def test_rendered_people_alone_will_do(self):
        photos = people.Packed(self.packed, "train")
        frames = [i for i, entry in enumerate(photos.index) if entry["kind"] == "ccp_masked"]
        index = [photos.index[i] | {"kind": "rendered"} for i in frames]
        (self.packed / "frames.json").write_text(json.dumps(index))
        shutil.copyfile(self.packed / "train.bin", self.packed / "frames.bin")
        samples = Samples(self.packed, (64, 48), 40, rendered="frames", sources=["kitchen"])
        self.assertEqual(set(samples._cutouts), {"rendered"})
        self.assertAlmostEqual(sum(samples._shares.values()), 1)
        self.assertEqual(set(samples._shares), {"composed", "empty", "render"})
        shown = sum(bool((samples[i][1] == 1).any()) for i in range(40))
        self.assertGreater(shown, 15)

    def test_more_samples_without_people(self):
        samples = Samples(self.packed, (64, 48), 60, empty=0.8)
        self.assertAlmostEqual(samples._shares["empty"], 0.8)
        self.assertAlmostEqual(sum(samples._shares.values()), 1)
        shown = sum(bool((samples[i][1] == 1).any()) for i in range(60))
        self.assertGreater(shown, 3)
        self.assertLess(shown, 25)

    def test_composed_labels_lie_on_the_pasted_people(self):
        packed = people.Packed(self.packed, "train")
        i = next(i for i, e in enumerate(packed.index) if e["kind"] == "ccp_masked")
        rng = np.random.default_rng(5)
        for _ in range(20):
            frame = np.full((96, 128, 3), (0, 255, 0), np.uint8)
            image, label = compose(rng, frame, [(packed.index[i], packed[i])], (128, 96))
            pure = (image == (0, 255, 0)).all(2)
            self.assertFalse((pure & (label == 1)).any())
            self.assertGreater(pure[label == 0].mean(), 0.8)

    def test_evaluation_sets(self):
        packed = people.Packed(self.packed, "validation")
        for pairs in (evaluation_sets.photos(packed, people.KINDS, (64, 64)),
                      evaluation_sets.composed(packed, (64, 64), 3),
                      evaluation_sets.close_ups(packed, (64, 64), 3),
                      evaluation_sets.turned(evaluation_sets.composed(packed, (64, 64), 3)),
                      evaluation_sets.without_people(packed, (64, 64), True)):
            self.assertTrue(pairs)
            for image, label in pairs:
                self.assertEqual((image.shape, label.shape), ((64, 64, 3), (64, 64)))

    def test_fitting_keeps_the_shape_and_ignores_the_rest(self):
        packed = np.ones((40, 20, 4), np.uint8)
        _, label = evaluation_sets.fitted(packed, (80, 80))
        self.assertEqual((label == 1).sum(), 80 * 40)
        self.assertEqual((label == 255).sum(), 80 * 40)


class ValidationListTest(unittest.TestCase):
    def test_the_list_in_the_repository(self):
        lines = people.VALIDATION_LIST.read_text().splitlines()[1:]
        chosen = people.read_validation()
        counts = Counter(kind for kind, _ in chosen)
        self.assertEqual(set(counts), {*people.KINDS, people.EMPTY})
        self.assertEqual(sum(counts.values()), len(lines))  # no line twice
        for kind, name in chosen:
            if kind == people.EMPTY:
                self.assertTrue(name.startswith(people.VALIDATION_SCENES), name)


if __name__ == "__main__":
    unittest.main()
