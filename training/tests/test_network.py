"""The networks: names and shapes of the file contract, attention, fusion."""

from . import with_torch  # noqa: F401  # isort: skip

import unittest

import torch

from stdc_training.layers import StdcModule
from stdc_training.network import StdcSeg, inference_state


class NetworkTest(unittest.TestCase):
    def test_logits_are_an_eighth_for_any_multiple_of_32(self):
        network = StdcSeg(divisor=8, head=8).eval()
        for height, width in ((32, 32), (64, 96), (160, 32)):
            logits = network(torch.zeros(1, 3, height, width))
            self.assertEqual(tuple(logits.shape), (1, 2, height // 8, width // 8))

    def test_training_outputs(self):
        outputs = StdcSeg(divisor=8, head=8).forward_training(torch.zeros(2, 3, 64, 96))
        shapes = {name: tuple(logits.shape) for name, logits in outputs.items()}
        self.assertEqual(shapes, {"main": (2, 2, 8, 12), "context8": (2, 2, 8, 12),
                                  "context16": (2, 2, 4, 6), "detail": (2, 1, 8, 12)})

    def test_names_and_shapes_of_the_file(self):
        state = inference_state(StdcSeg())
        expected = {
            "backbone.stage1.conv.weight": (32, 3, 3, 3),
            "backbone.stage3.0.blocks.0.conv.weight": (128, 64, 1, 1),
            "backbone.stage3.0.blocks.1.conv.weight": (64, 128, 3, 3),
            "backbone.stage5.1.blocks.3.conv.weight": (128, 128, 3, 3),
            "backbone.stage5.1.blocks.3.bn.running_var": (128,),
            "context.pool.conv.weight": (128, 1024, 1, 1),
            "context.arm5.conv.conv.weight": (128, 1024, 3, 3),
            "context.arm4.attention.conv.weight": (128, 128, 1, 1),
            "context.arm4.attention.bn.bias": (128,),
            "context.head4.conv.weight": (128, 128, 3, 3),
            "ffm.conv.conv.weight": (256, 384, 1, 1),
            "ffm.squeeze.weight": (64, 256, 1, 1),
            "ffm.excite.weight": (256, 64, 1, 1),
            "head.conv.conv.weight": (64, 256, 3, 3),
            "head.classify.weight": (2, 64, 1, 1),
            "head.classify.bias": (2,),
        }
        for name, shape in expected.items():
            self.assertEqual(tuple(state[name].shape), shape, name)
        self.assertFalse([n for n in state if n.startswith(("detail", "auxiliary"))])
        self.assertFalse([n for n in state if n.endswith("num_batches_tracked")])

    def test_module_counts(self):
        for architecture, counts in (("STDC1-Seg", (2, 2, 2)), ("STDC2-Seg", (4, 5, 3))):
            backbone = StdcSeg(architecture, divisor=8, head=8).backbone
            stages = (backbone.stage3, backbone.stage4, backbone.stage5)
            self.assertEqual(tuple(len(stage) for stage in stages), counts)

    def test_unknown_architecture(self):
        with self.assertRaisesRegex(ValueError, "STDC1-Seg"):
            StdcSeg("STDC3")

    def test_module_with_stride_pools_its_first_block(self):
        module = StdcModule(8, (8, 4, 2, 2), 2).eval()
        x = torch.randn(1, 8, 12, 12)
        first = torch.nn.functional.avg_pool2d(module.blocks[0](x), 3, 2, 1)
        output = module(x)
        self.assertEqual(tuple(output.shape), (1, 16, 6, 6))
        self.assertTrue(torch.equal(output[:, :8], first))


if __name__ == "__main__":
    unittest.main()
