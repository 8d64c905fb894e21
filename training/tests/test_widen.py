"""A widened network computes what the narrow one does, and learns with its new channels."""

from . import with_torch  # noqa: F401  # isort: skip

import unittest

import torch

from stdc_training.fixture import random_network
from stdc_training.network import StdcSeg
from stdc_training.widen import widen


class WidenTest(unittest.TestCase):
    def test_the_same_logits(self):
        for architecture in ("STDC1-Seg", "STDC2-Seg"):
            narrow = random_network(architecture, 5)
            wide = StdcSeg(architecture, divisor=4, head=narrow.head.conv.conv.out_channels)
            widen(narrow, wide)
            image = torch.randn(2, 3, 64, 96)
            with torch.no_grad():
                torch.testing.assert_close(wide.eval()(image), narrow(image), rtol=1e-4, atol=1e-4)

    def test_heads_of_training_too(self):
        narrow, wide = StdcSeg(divisor=8, head=8), StdcSeg(divisor=4, head=16)
        widen(narrow, wide)
        image = torch.randn(1, 3, 64, 64)
        with torch.no_grad():
            expected = narrow.eval().forward_training(image)
            found = wide.eval().forward_training(image)
        for name, logits in expected.items():
            torch.testing.assert_close(found[name], logits, rtol=1e-4, atol=1e-4)

    def test_new_channels_get_gradients(self):
        wide = StdcSeg(divisor=4, head=16)
        widen(StdcSeg(divisor=8, head=8), wide)
        wide.train()(torch.randn(2, 3, 64, 64)).square().mean().backward()
        head = wide.head.conv.conv.weight.grad
        self.assertGreater(float(head[:8, 16:].abs().max()), 0)


if __name__ == "__main__":
    unittest.main()
