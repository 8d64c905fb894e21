"""The mean of several weights files."""

from . import with_torch  # noqa: F401  # isort: skip

import unittest

import torch

from stdc_training import fixture, mean, weights


class MeanTest(unittest.TestCase):
    def test_shares_weigh_every_number(self):
        one, two = (fixture.random_network("STDC1-Seg", seed) for seed in (5, 6))
        name = "backbone.stage2.conv.weight"
        expected = 0.25 * one.state_dict()[name] + 0.75 * two.state_dict()[name]
        found = mean.mean_of([one, two], [1, 3]).state_dict()[name]
        torch.testing.assert_close(found, expected)

    def test_other_channels_are_refused(self):
        narrow = fixture.random_network("STDC1-Seg", 5)
        other = fixture.random_network("STDC2-Seg", 5)
        with self.assertRaisesRegex(ValueError, "different channels"):
            mean.mean_of([narrow, other], [1, 1])

    def test_shares_must_be_as_many_as_files_and_not_negative(self):
        networks = [fixture.random_network("STDC1-Seg", seed) for seed in (5, 6)]
        for shares in ([1], [1, -1], [0, 0]):
            with self.assertRaises(ValueError):
                mean.mean_of(networks, shares)

    def test_statistics_are_those_of_the_samples(self):
        network = fixture.random_network("STDC1-Seg", 5)
        samples = [(fixture.smooth_image(seed)[0], 0) for seed in range(8)]
        mean.measure_statistics(network, samples, batch=4)
        first = next(module for module in network.modules() if isinstance(module, torch.nn.BatchNorm2d))
        seen = []
        handle = first.register_forward_hook(lambda _, inputs, __: seen.append(inputs[0]))
        with torch.no_grad():
            for begin in (0, 4):
                network(weights.normalised(torch.stack([pixels for pixels, _ in samples[begin:begin + 4]])))
        handle.remove()
        expected = torch.cat(seen).mean(dim=(0, 2, 3))
        torch.testing.assert_close(first.running_mean, expected, rtol=1e-4, atol=1e-4)

    def test_what_is_not_permissive_stays_so(self):
        self.assertEqual(mean.licence_of_mean([{"licence": "Trained on sources with permissive terms only: a"},
                                               {"licence": "Weights for research use only: b"}]),
                         "Weights for research use only: b")


if __name__ == "__main__":
    unittest.main()
