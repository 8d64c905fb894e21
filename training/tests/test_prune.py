"""Pruning: the budget is kept, redundant channels go first, the slim network says the same."""

from . import with_torch  # noqa: F401  # isort: skip

import tempfile
import unittest
from pathlib import Path

import numpy as np
import torch

from stdc_training import channel_choice, prune, weights
from stdc_training.network import StdcSeg
from stdc_training.widths import Widths


def images(count=4, size=(96, 64)):
    """Smooth random images: neighbouring places of a layer are alike, as in photos."""
    torch.manual_seed(5)
    coarse = torch.randn(count, 3, size[1] // 16, size[0] // 16)
    fine = torch.nn.functional.interpolate(coarse, size=size[::-1], mode="bicubic")
    return list((fine + 0.1 * torch.randn_like(fine)).split(2))


def redundant_network():
    """A network of which half the channels of each stage's end say the same as the other half."""
    torch.manual_seed(3)
    network = StdcSeg(divisor=2, head=32, training_heads=False).eval()
    with torch.no_grad():
        for name, (_, group) in prune.wiring(network.widths).items():
            if group and "attention" not in name and "excite" not in name:
                weight = dict(network.named_modules())[name].weight
                weight[len(weight) // 2:] = weight[:len(weight) // 2]
    return network


class WidthsTest(unittest.TestCase):
    def test_read_from_the_tensors(self):
        for architecture in ("STDC1-Seg", "STDC2-Seg"):
            network = StdcSeg(architecture, divisor=4, head=24)
            self.assertEqual(Widths.of(network.state_dict(), architecture), network.widths)

    def test_counts_and_back(self):
        widths = Widths.uniform()
        counts = channel_choice.counts_of(widths)
        self.assertEqual(counts["backbone.stage4.1.blocks.0"], 256)
        self.assertEqual(channel_choice.widths_with(counts, widths), widths)

    def test_multiplications_are_those_of_the_layers(self):
        network = StdcSeg(divisor=2, training_heads=False).eval()
        found = 0.0

        def count(conv, _, output):
            nonlocal found
            if output.shape[2] > 1:  # not those of a whole image's average
                found += conv.weight[0].numel() * output.numel()

        for name, module in network.named_modules():
            if isinstance(module, torch.nn.Conv2d) and name != "head.classify":
                module.register_forward_hook(count)
        network(torch.zeros(1, 3, 64, 96))
        self.assertEqual(channel_choice.multiplications(network.widths, (96, 64)), found)


class ChoiceTest(unittest.TestCase):
    def test_copies_go_first_and_cost_nothing(self):
        rng = np.random.default_rng(1)
        own = rng.standard_normal((6, 500))
        values = np.vstack([own, 2 * own[:3]])
        slopes = rng.standard_normal((9, 200))
        order, errors = channel_choice.elimination(values @ values.T / 500, slopes @ slopes.T)
        self.assertEqual({i % 6 for i in order[:3]}, {0, 1, 2})
        self.assertLess(errors[2], 0.01 * errors[4])
        kept = np.setdiff1d(np.arange(9), order[:3])
        again = channel_choice.regression(values @ values.T, kept) @ values[kept]
        np.testing.assert_allclose(again, values, atol=0.02)

    def test_the_budget_is_kept(self):
        widths = Widths.uniform()
        errors = {name: np.cumsum(np.arange(1.0, count))
                  for name, count in channel_choice.counts_of(widths).items()}
        full = channel_choice.multiplications(widths, (96, 64))
        slim = channel_choice.spend(widths, errors, (96, 64), 0.3 * full)
        self.assertLessEqual(channel_choice.multiplications(slim, (96, 64)), 0.3 * full)
        self.assertGreater(channel_choice.multiplications(slim, (96, 64)), 0.25 * full)
        for count in channel_choice.counts_of(slim).values():
            self.assertEqual(count % channel_choice.CHUNK, 0)
        with self.assertRaisesRegex(ValueError, "too few"):
            channel_choice.spend(widths, errors, (96, 64), 0.01 * full)


class PruneTest(unittest.TestCase):
    def test_a_redundant_network_keeps_its_output(self):
        wide = redundant_network()
        batches = images()
        with torch.no_grad():
            expected = torch.cat([wide(batch) for batch in batches])
        for fitted in (False, True):
            slim = prune.prune(wide, (96, 64), 0.6, lambda: batches, fitted, lambda _: None)
            with torch.no_grad():
                found = torch.cat([slim(batch) for batch in batches])
            error = (found - expected).square().mean() / expected.var()
            self.assertLess(float(error), 0.02, f"fitted: {fitted}")

    def test_the_file_starts_a_network_of_its_widths(self):
        slim = prune.prune(redundant_network(), (96, 64), 0.6, images, False, lambda _: None)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "slim.safetensors"
            weights.save(file, slim, weights.metadata(slim, (96, 64), ""), half=False)
            architecture, widths = weights.widths_of(file)
            network = StdcSeg(architecture, widths=widths)
            weights.begin_from(file, network)
            frozen = weights.load_frozen(file)
        image = images()[0]
        with torch.no_grad():
            torch.testing.assert_close(network.eval()(image), slim(image), rtol=1e-4, atol=1e-4)
            torch.testing.assert_close(frozen(image), slim(image), rtol=1e-3, atol=1e-3)


if __name__ == "__main__":
    unittest.main()
