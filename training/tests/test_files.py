"""Weights files: the fixture, calibration."""

from . import with_torch  # noqa: F401  # isort: skip

import json
import os
import tempfile
import unittest

import numpy as np
import torch

from stdc_training import calibrate, fixture, safetensors, weights


class FixtureTest(unittest.TestCase):
    def test_files_reproduce_their_logits(self):
        with tempfile.TemporaryDirectory() as folder:
            fixture.write_fixture(folder, "tiny", "STDC2-Seg", 5)
            network, metadata = weights.load(os.path.join(folder, "tiny.safetensors"))
            reference, _ = safetensors.read(os.path.join(folder, "tiny_reference.safetensors"))
        self.assertEqual(network.architecture, "STDC2-Seg")
        self.assertEqual(json.loads(metadata["dynamic_classes"]), ["person"])
        with torch.no_grad():
            logits = network(torch.from_numpy(reference["input"].copy())[None])[0]
        np.testing.assert_allclose(logits.numpy(), reference["logits"], rtol=1e-4, atol=1e-4)

    def test_every_convolution_has_a_range(self):
        network = fixture.random_network("STDC1-Seg", 5)
        images = weights.normalised(fixture.smooth_image(5))
        ranges = calibrate.activation_ranges(network, [images])
        names = {name for name, module in network.named_modules()
                 if isinstance(module, torch.nn.Conv2d)}
        self.assertEqual(set(ranges), names | {"input"})
        self.assertLess(ranges["input"][0], 0)
        self.assertEqual(ranges["backbone.stage2.conv"][0], 0)
        self.assertTrue(all(high > 0 for _, high in ranges.values()))

    def test_percentile_cuts_rare_extremes(self):
        values = np.zeros(100_000, np.float32)
        values[0] = 1000
        values[1:1000] = 2
        self.assertEqual(calibrate._range(values, 99.9), [0.0, 2.0])


if __name__ == "__main__":
    unittest.main()
