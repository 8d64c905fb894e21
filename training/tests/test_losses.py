"""Detail guidance and hard cross-entropy on cases that can be worked out by hand."""

import math
import unittest

import torch

from stdc_training.detail import DetailTarget, detail_loss
from stdc_training.losses import hard_cross_entropy


class DetailTest(unittest.TestCase):
    def test_edges_of_a_square(self):
        labels = torch.zeros(1, 32, 32, dtype=torch.long)
        labels[:, 8:24, 8:24] = 1
        target = DetailTarget()(labels).detach()[0, 0]
        self.assertEqual(set(target.unique().tolist()), {0.0, 1.0})
        self.assertEqual(target[8, 8:24].min(), 1)  # the whole upper edge
        self.assertEqual(target[16, 16], 0)  # deep inside
        self.assertEqual(target[2, 2], 0)  # far outside

    def test_nobody_gives_an_empty_map_also_at_the_rim(self):
        self.assertEqual(DetailTarget()(torch.zeros(1, 32, 48, dtype=torch.long)).sum(), 0)
        self.assertEqual(DetailTarget()(torch.ones(1, 32, 48, dtype=torch.long)).sum(), 0)

    def test_weights_of_the_fusion_are_trained(self):
        labels = torch.zeros(1, 32, 32, dtype=torch.long)
        labels[:, 5:20, 9:24] = 1
        target = DetailTarget()
        logits = torch.randn(1, 1, 32, 32)
        detail_loss(logits, target(labels), torch.ones(1, 1, 32, 32)).backward()
        self.assertGreater(target.fuse.grad.abs().sum(), 0)

    def test_loss_is_small_only_for_the_right_map(self):
        target = (torch.rand(2, 1, 16, 16) > 0.8).float()
        known = torch.ones_like(target)
        self.assertLess(detail_loss((target * 2 - 1) * 20, target, known), 1e-4)
        self.assertGreater(detail_loss((1 - target * 2) * 20, target, known), 10)

    def test_unknown_pixels_do_not_count(self):
        target, known = torch.zeros(1, 1, 8, 8), torch.ones(1, 1, 8, 8)
        known[..., :4] = 0
        logits = torch.full((1, 1, 8, 8), -20.0)
        logits[..., :4] = 20
        self.assertLess(detail_loss(logits, target, known), 1e-4)


class HardCrossEntropyTest(unittest.TestCase):
    @staticmethod
    def logits(probabilities):
        p = torch.tensor(probabilities).view(1, 1, -1)
        return torch.stack([torch.zeros_like(p), torch.log(p / (1 - p))], 1)

    def test_only_hard_pixels_count(self):
        labels = torch.ones(1, 1, 4, dtype=torch.long)
        loss = hard_cross_entropy(self.logits([0.9, 0.95, 0.5, 0.25]), labels)
        self.assertAlmostEqual(float(loss), (math.log(2) + math.log(4)) / 2, 5)

    def test_the_hardest_share_counts_always(self):
        labels = torch.ones(1, 1, 4, dtype=torch.long)
        loss = hard_cross_entropy(self.logits([0.9, 0.95, 0.99, 0.8]), labels, least_share=0.25)
        self.assertAlmostEqual(float(loss), -math.log(0.8), 5)

    def test_ignored_pixels(self):
        labels = torch.tensor([[[255, 255, 1, 255]]])
        loss = hard_cross_entropy(self.logits([0.1, 0.1, 0.5, 0.1]), labels)
        self.assertAlmostEqual(float(loss), math.log(2), 5)
        labels[:] = 255
        self.assertEqual(float(hard_cross_entropy(self.logits([0.1] * 4), labels)), 0)


if __name__ == "__main__":
    unittest.main()
