"""The optimiser: orthogonal factors, equality with AdamW where it is AdamW, checkpoints."""

from . import with_torch  # noqa: F401  # isort: skip

import unittest

import torch

from stdc_training.muon import Muon, orthogonal, orthogonal_bf16


class OrthogonalTest(unittest.TestCase):
    def test_singular_values_are_near_one(self):
        torch.manual_seed(1)
        for shape in ((16, 27), (64, 48), (32, 288)):
            factor = orthogonal(torch.randn(shape))
            self.assertEqual(tuple(factor.shape), shape)
            values = torch.linalg.svdvals(factor)
            self.assertGreater(float(values.min()), 0.3)
            self.assertLess(float(values.max()), 1.3)

    def test_products_of_16_bit_give_much_the_same(self):
        torch.manual_seed(1)
        for shape in ((16, 27), (64, 48)):
            matrix = torch.randn(shape)
            difference = orthogonal_bf16(matrix) - orthogonal(matrix)
            self.assertLess(float(difference.norm() / orthogonal(matrix).norm()), 0.1)

    def test_directions_are_kept(self):
        torch.manual_seed(2)
        matrix = torch.randn(12, 40)
        left, _, right = torch.linalg.svd(matrix, full_matrices=False)
        core = left.T @ orthogonal(matrix) @ right.T
        off = core - torch.diag(torch.diag(core))
        self.assertLess(float(off.abs().max()), 1e-3)

    def test_no_gradient_gives_no_step(self):
        self.assertEqual(float(orthogonal(torch.zeros(4, 9)).abs().max()), 0)


class MuonTest(unittest.TestCase):
    def test_other_groups_move_as_adamw_moves_them(self):
        torch.manual_seed(3)
        start, target = torch.randn(30), torch.randn(30)
        ends = []
        for kind in (Muon, torch.optim.AdamW):
            weights = torch.nn.Parameter(start.clone())
            groups = [{"params": [weights], "weight_decay": 0.1, "orthogonal": False}]
            optimiser = kind(groups, lr=0.01, betas=(0.9, 0.99))
            for _ in range(20):
                optimiser.zero_grad()
                ((weights - target) ** 3).abs().sum().backward()
                optimiser.step()
            ends.append(weights.detach())
        torch.testing.assert_close(ends[0], ends[1], rtol=1e-5, atol=1e-6)

    def test_convolutions_move_by_the_size_of_an_adamw_step(self):
        torch.manual_seed(4)
        weights = torch.nn.Parameter(torch.zeros(64, 32, 3, 3))
        optimiser = Muon([{"params": [weights], "orthogonal": True}], lr=1.0)
        weights.grad = torch.randn_like(weights)
        optimiser.step()
        self.assertAlmostEqual(float(weights.detach().square().mean().sqrt()), 0.2, delta=0.06)


if __name__ == "__main__":
    unittest.main()
