"""Labels from views that agree."""

from . import with_torch  # noqa: F401  # isort: skip

import unittest

import numpy as np

from stdc_training import agree
from stdc_training.fixture import random_network, smooth_image


class AgreeTest(unittest.TestCase):
    def test_unknown_without_agreement(self):
        views = np.array([[[0.9, 0.1, 0.9, 0.55]], [[0.7, 0.3, 0.2, 0.9]]])
        self.assertEqual(agree.agreed(views).tolist(), [[1, 0, 255, 255]])

    def test_mirrored_views_are_turned_back(self):
        network = random_network("STDC1-Seg", 4)
        picture = smooth_image(4)[0].numpy()
        views = agree.chances(network, picture, ((96, 64),))
        mirrored = agree.chances(network, np.ascontiguousarray(picture[:, ::-1]), ((96, 64),))
        self.assertEqual(views.shape, (2, 64, 96))
        np.testing.assert_allclose(views[0], mirrored[1][:, ::-1], atol=1e-4)
        np.testing.assert_allclose(views[1], mirrored[0][:, ::-1], atol=1e-4)

    def test_sheet(self):
        picture = np.full((48, 64, 3), 100, np.uint8)
        label = np.zeros((48, 64), np.uint8)
        label[:, 32:] = 1
        shown = agree.sheet(picture, label, 64)
        self.assertEqual(shown[20, 10].tolist(), [100, 100, 100])
        self.assertEqual(shown[20, 50].tolist(), [162, 60, 60])


if __name__ == "__main__":
    unittest.main()
