"""Calibrated probabilities: what was distorted is found again. Needs numpy and cv2."""

import tempfile
import unittest
from pathlib import Path

import cv2
import numpy as np

from stdc_training import fit_probability


class FitProbabilityTest(unittest.TestCase):
    def test_distorted_odds_are_straightened(self):
        random = np.random.default_rng(2)
        with tempfile.TemporaryDirectory() as folder:
            for name in range(6):
                odds = random.normal(0, 2, (60, 80))
                label = (random.random(odds.shape) < 1 / (1 + np.exp(-odds))).astype(np.uint8)
                label[:5] = 255
                told = 1 / (1 + np.exp(-(2.5 * odds + 0.7)))  # too sure, and in favour of people
                cv2.imwrite(f"{folder}/{name}-probability.png", np.uint16(np.round(told * 65535)))
                Path(folder, "label").mkdir(exist_ok=True)
                cv2.imwrite(f"{folder}/label/{name}.png", label)
            pairs = fit_probability.load(folder, f"{folder}/label")
        self.assertEqual(len(pairs), 6)
        scale, offset = fit_probability.fit(*fit_probability.joined(pairs[::2]))
        self.assertAlmostEqual(scale, 1 / 2.5, delta=0.05)
        self.assertAlmostEqual(offset, -0.7 / 2.5, delta=0.1)
        odds, truth = fit_probability.joined(pairs[1::2])
        error = fit_probability.calibration_error
        before = error(fit_probability.probability(odds, 1, 0), truth)
        after = error(fit_probability.probability(odds, scale, offset), truth)
        self.assertGreater(before, 0.08)
        self.assertLess(after, 0.05)

    def test_too_few_images_are_refused(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(SystemExit):
            fit_probability.load(folder, folder)


if __name__ == "__main__":
    unittest.main()
