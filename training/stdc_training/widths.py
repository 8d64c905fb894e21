"""How many channels each layer of a network has."""

from dataclasses import dataclass

MODULES = {"STDC1-Seg": (2, 2, 2), "STDC2-Seg": (4, 5, 3)}


@dataclass(frozen=True)
class Widths:
    """Output channels of all layers.

    stem: of stages 1 and 2; stages: of the four blocks of each module of stages 3 to 5; context:
    of the context features at 1/32, at 1/16 and at 1/8 of the image; squeeze: of the bottleneck of
    the fusion's attention.
    """

    stem: tuple
    stages: tuple
    context: tuple
    fusion: int
    squeeze: int
    head: int

    @staticmethod
    def uniform(architecture="STDC1-Seg", divisor=1, head=64):
        """The paper's network, all layers narrowed by `divisor`.

        The segmentation head has 64 channels instead of the paper's 256: with two classes it costs
        an eighth of the whole network otherwise and gains nothing.
        """
        if architecture not in MODULES:
            raise ValueError(f"unknown architecture {architecture!r}: use one of {sorted(MODULES)}")
        stages = tuple(
            tuple(tuple(outputs // divisor // part for part in (2, 4, 8, 8)) for _ in range(count))
            for outputs, count in zip((256, 512, 1024), MODULES[architecture]))
        fusion = 256 // divisor
        return Widths((32 // divisor, 64 // divisor), stages, (128 // divisor,) * 3, fusion,
                      fusion // 4, head)

    @staticmethod
    def of(tensors, architecture):
        """The widths of a network given by its tensors (anything with a shape), by name."""
        def outputs(layer):
            return int(tensors[layer + ".weight"].shape[0])

        stages = tuple(
            tuple(tuple(outputs(f"backbone.stage{stage}.{i}.blocks.{k}.conv") for k in range(4))
                  for i in range(count))
            for stage, count in zip((3, 4, 5), MODULES[architecture]))
        stem = tuple(outputs(f"backbone.stage{stage}.conv") for stage in (1, 2))
        context = tuple(outputs(f"context.{name}.conv") for name in ("pool", "head5", "head4"))
        return Widths(stem, stages, context, outputs("ffm.conv.conv"), outputs("ffm.squeeze"),
                      outputs("head.conv.conv"))
