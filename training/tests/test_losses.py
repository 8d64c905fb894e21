"""Detail guidance and hard cross-entropy on cases that can be worked out by hand."""

from . import with_torch  # noqa: F401  # isort: skip

import math
import unittest

import torch

from stdc_training.detail import DetailTarget, detail_loss
from stdc_training.losses import (hard_cross_entropy, margin, outline_weights,
                                   plain_cross_entropy, soft_labels, softened, total_loss,
                                   without_doubt)


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


class CrossEntropyTest(unittest.TestCase):
    @staticmethod
    def loss(kind, probabilities, labels, **options):
        p = torch.tensor(probabilities).view(1, 1, -1)
        labels = torch.tensor(labels).view(1, 1, -1)
        return float(kind(torch.log(p / (1 - p)), *soft_labels(labels, 1), **options))

    def test_only_hard_pixels_count(self):
        loss = self.loss(hard_cross_entropy, [0.9, 0.95, 0.5, 0.25], [1] * 4)
        self.assertAlmostEqual(loss, (math.log(2) + math.log(4)) / 2, 5)

    def test_the_hardest_share_counts_always(self):
        loss = self.loss(hard_cross_entropy, [0.9, 0.95, 0.99, 0.8], [1] * 4, least_share=0.25)
        self.assertAlmostEqual(loss, -math.log(0.8), 5)

    def test_ignored_pixels(self):
        for kind in (hard_cross_entropy, plain_cross_entropy):
            self.assertAlmostEqual(self.loss(kind, [0.1, 0.1, 0.5, 0.1], [255, 255, 1, 255]),
                                   math.log(2), 5)
            self.assertEqual(self.loss(kind, [0.1] * 4, [255] * 4), 0)

    def test_it_is_the_cross_entropy_of_two_classes(self):
        torch.manual_seed(5)
        logits, labels = torch.randn(2, 2, 8, 8), torch.randint(0, 2, (2, 8, 8))
        loss = plain_cross_entropy(margin(logits, (8, 8)), *soft_labels(labels, 1))
        torch.testing.assert_close(loss, torch.nn.functional.cross_entropy(logits, labels))

    def test_outlines_count_more(self):
        labels = torch.tensor([[[0, 0, 0, 0, 1, 1, 1, 1, 255, 0]]])
        weights = outline_weights(*soft_labels(labels, 1), 3.0, reach=2)
        # Between the person and what is unknown nobody knows an outline.
        self.assertEqual(weights.flatten().tolist(), [1, 1, 3, 3, 3, 3, 1, 3, 3, 3])
        margins = torch.full((1, 1, 10), -2.0)
        margins[0, 0, 4] = 2.0  # wrong within the person's inside only, or at its outline only
        known = soft_labels(labels, 1)
        plain = float(plain_cross_entropy(margins, *known))
        weighted = float(plain_cross_entropy(margins, *known, weights))
        wrong, right = math.log1p(math.exp(2)), math.log1p(math.exp(-2))
        self.assertAlmostEqual(plain, (3 * wrong + 6 * right) / 9, 5)
        # Background: 1, 1, 3, 3 and 3; person: 3 (right), 3, 1, 3.
        self.assertAlmostEqual(weighted, (7 * wrong + 14 * right) / 21, 5)

    def test_squares_carry_the_shares_of_their_labels(self):
        labels = torch.tensor([[[1, 0, 255, 255], [1, 1, 255, 0]]])
        person, known = soft_labels(labels, 2)
        self.assertEqual(person.tolist(), [[[0.75, 0.0]]])
        self.assertEqual(known.tolist(), [[[1.0, 0.25]]])
        right = plain_cross_entropy(torch.tensor([[[math.log(3.0), -30.0]]]), person, known)
        other = plain_cross_entropy(torch.tensor([[[math.log(4.0), -30.0]]]), person, known)
        self.assertLess(float(right), float(other))

    def test_a_teacher_softens_the_labels(self):
        person, known = soft_labels(torch.tensor([[[1, 0, 255]]]), 1)
        mixed = softened(person, known, torch.full((1, 1, 3), math.log(3.0)), 0.5)
        torch.testing.assert_close(mixed, torch.tensor([[[0.875, 0.375, 0.0]]]))

    def test_its_mistakes_are_not_learnt_where_labels_are_exact(self):
        person, known = soft_labels(torch.tensor([[[1, 0, 0]]] * 2), 1)
        margins = torch.full((2, 1, 3), math.log(3.0))
        margins[..., 2] *= -1
        mixed = softened(person, known, margins, 0.5, torch.tensor([0, 1]))
        torch.testing.assert_close(mixed, torch.tensor([[[0.875, 0.375, 0.125]],
                                                        [[0.875, 0.0, 0.125]]]))

    def test_doubtful_labels_of_a_network_are_unknown(self):
        labels = torch.tensor([[[1, 0, 1, 0]]] * 2)
        margins = torch.tensor([[[-5.0, 5.0, 5.0, 0.5]]] * 2)
        teacher = torch.stack([torch.zeros_like(margins), margins], 1)
        found = without_doubt(labels, torch.tensor([0, 1]), teacher)
        self.assertEqual(found.tolist(), [[[255, 255, 1, 0]], [[1, 0, 1, 0]]])

    def test_without_heads_of_training(self):
        labels = torch.randint(0, 2, (2, 64, 64))
        loss, parts = total_loss({"main": torch.randn(2, 2, 8, 8)}, labels, DetailTarget(), False, 2)
        self.assertEqual(set(parts), {"main", "region"})
        self.assertAlmostEqual(float(loss), float(sum(parts.values())), 5)


if __name__ == "__main__":
    unittest.main()
