"""Outlines drawn by hand."""

from . import with_torch  # noqa: F401  # isort: skip

import tempfile
import unittest
from pathlib import Path

import cv2
import numpy as np

from stdc_training import outlines


class OutlinesTest(unittest.TestCase):
    def test_the_list(self):
        found = outlines.read()
        self.assertGreater(sum(corners is not None for _, _, corners in found), 10)
        self.assertGreater(sum(corners is None for _, _, corners in found), 20)
        for sequence, _, corners in found:
            self.assertIn(sequence, ("freiburg1_xyz", "freiburg1_rpy"))
            share = outlines.label(corners, (480, 640)).mean()
            self.assertTrue(share == 0 if corners is None else 0.005 < share < 0.2)

    def test_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            rgb = Path(folder) / "rgbd_dataset_freiburg1_xyz_first300" / "rgb"
            rgb.mkdir(parents=True)
            cv2.imwrite(str(rgb / "12.5.jpg"), np.zeros((8, 8, 3), np.uint8))
            self.assertEqual(outlines.picture_of(folder, "freiburg1_xyz", "12.5").shape, (8, 8, 3))
            with self.assertRaisesRegex(FileNotFoundError, "12.6"):
                outlines.picture_of(folder, "freiburg1_xyz", "12.6")


if __name__ == "__main__":
    unittest.main()
