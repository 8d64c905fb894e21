"""Scores on masks whose scores can be worked out by hand."""

from . import with_torch  # noqa: F401  # isort: skip

import unittest

import numpy as np

from stdc_training import metrics
from stdc_training.predict import intersection_over_union, overlap


def square(x, size=20, shape=(60, 80)):
    mask = np.zeros(shape, bool)
    mask[10:10 + size, x:x + size] = True
    return mask


class MetricsTest(unittest.TestCase):
    def test_shifted_square(self):
        found, label = square(10), square(20).astype(np.uint8)
        scores = metrics.scores(found, label)
        self.assertAlmostEqual(scores["iou"], 1 / 3)
        self.assertAlmostEqual(scores["precision"], 0.5)
        self.assertAlmostEqual(scores["recall"], 0.5)
        self.assertAlmostEqual(scores["wrong_share"], 200 / 4800)

    def test_perfect_and_empty(self):
        self.assertEqual(metrics.scores(square(10), square(10).astype(np.uint8))["iou"], 1)
        self.assertEqual(metrics.scores(square(10), square(10).astype(np.uint8))["boundary_f"], 1)
        nothing = np.zeros((60, 80), bool)
        self.assertEqual(metrics.scores(nothing, nothing.astype(np.uint8))["boundary_f"], 1)
        self.assertEqual(intersection_over_union(overlap(nothing, nothing.astype(np.uint8))), 1)

    def test_ignored_pixels_do_not_count(self):
        label = square(20).astype(np.uint8)
        label[:, :25] = 255
        self.assertEqual(metrics.scores(square(10, 30)[:, :] & (label == 1), label)["iou"], 1)

    def test_boundary_tolerates_one_pixel_but_not_ten(self):
        label = square(20).astype(np.uint8)
        self.assertEqual(metrics.boundary_f(square(21), label), 1)
        self.assertLess(metrics.boundary_f(square(30), label), 0.75)

    def test_rim_is_no_boundary(self):
        self.assertEqual(metrics.boundary(np.ones((10, 10), bool)).sum(), 0)


if __name__ == "__main__":
    unittest.main()
