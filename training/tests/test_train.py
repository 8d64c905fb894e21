"""Training on made-up data: it learns, it resumes, the average follows."""

from . import with_torch  # noqa: F401  # isort: skip

import tempfile
import unittest
from pathlib import Path

import torch

from stdc_training import export, quick_check, train, weights
from stdc_training.ema import Average

from .made_up import write_packed


class TrainTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        write_packed(cls.folder / "people", cls.folder / "packed")

    def options(self, run, images=400):
        return train.parse([str(self.folder / "packed"), str(self.folder / run), "--divisor", "8",
                            "--head", "8", "--width", "64", "--height", "32", "--batch", "8",
                            "--warmup", "5", "--rate", "5e-3", "--images", str(images),
                            "--loaders", "0", "--hard-after", "1000"])

    @staticmethod
    def run_steps(trainer, count):
        losses = []
        for batch in train.batches(trainer.options, trainer.images):
            losses.append(trainer.step(*batch)["main"])
            if len(losses) == count:
                break
        return losses

    def test_it_learns(self):
        trainer = train.Trainer(self.options("learns"))
        losses = self.run_steps(trainer, 40)
        self.assertLess(sum(losses[-5:]), 0.8 * sum(losses[:5]))

    def test_resumed_is_the_same_as_uninterrupted(self):
        whole = train.Trainer(self.options("whole"))
        self.run_steps(whole, 6)
        first = train.Trainer(self.options("parts"))
        self.run_steps(first, 3)
        first.save("last.pt")
        second = train.Trainer(self.options("parts"))
        second.resume()
        self.assertEqual((second.images, second.steps), (24, 3))
        self.run_steps(second, 3)
        for name, tensor in whole.average.network.state_dict().items():
            other = second.average.network.state_dict()[name]
            torch.testing.assert_close(tensor, other, rtol=1e-4, atol=1e-5, msg=name)

    def test_another_optimiser_warms_up_anew(self):
        first = train.Trainer(self.options("changed"))
        self.run_steps(first, 6)
        first.save("last.pt")
        options = self.options("changed")
        options.optimiser = "adamw"
        second = train.Trainer(options)
        second.resume()
        self.assertEqual((second.images, second.steps), (48, 6))
        self.assertEqual(second.warm_from, 6)
        self.assertFalse(second.optimiser.state)
        self.run_steps(second, 1)

    def test_begins_from_a_weights_file(self):
        first = train.Trainer(self.options("given"))
        self.run_steps(first, 3)
        file = self.folder / "given.safetensors"
        weights.save(file, first.average.network, weights.metadata(first.network, (64, 32), ""),
                     half=False)
        options = self.options("begun")
        options.start_from = str(file)
        begun = train.Trainer(options)
        for name, tensor in weights.load(file)[0].state_dict().items():
            torch.testing.assert_close(begun.network.state_dict()[name], tensor, msg=name)
            torch.testing.assert_close(begun.average.network.state_dict()[name], tensor, msg=name)
        options.divisor = 4
        wider = train.Trainer(options).network.eval()
        image = torch.randn(1, 3, 32, 64)
        with torch.no_grad():
            torch.testing.assert_close(wider(image), weights.load(file)[0](image),
                                       rtol=1e-4, atol=1e-4)
        options.divisor = 16
        with self.assertRaisesRegex(ValueError, "does not fit"):
            train.Trainer(options)

    def test_learns_from_a_teacher(self):
        teacher = train.Trainer(self.options("teacher"))
        file = self.folder / "teacher.safetensors"
        weights.save(file, teacher.average.network, weights.metadata(teacher.network, (64, 32), ""))
        options = self.options("taught")
        options.teacher, options.teacher_share, options.bf16 = str(file), 1.0, True
        self.run_steps(train.Trainer(options), 2)

    def test_scores_and_export(self):
        trainer = train.Trainer(self.options("scores"))
        trainer.best = -2.0
        sets = quick_check.validation_subset(self.folder / "packed", (64, 64))
        scores = train.evaluate(trainer, sets)
        self.assertEqual(set(scores), {"photos", "hard", "composed", "empty", "total"})
        network, state = export.from_checkpoint(self.folder / "scores" / "best.pt")
        self.assertEqual(state["images"], 0)
        image = torch.randn(1, 3, 32, 64)
        trainer.average.network.eval()
        network.to(memory_format=torch.channels_last)  # as in training: the same kernels
        with torch.no_grad():
            self.assertTrue(torch.equal(network(image), trainer.average.network(image)))

    def test_schedule(self):
        trainer = train.Trainer(self.options("schedule"))
        self.assertAlmostEqual(trainer.rate(), 5e-3 / 5)
        trainer.steps, trainer.images = 10, 200
        self.assertAlmostEqual(trainer.rate(), 5e-3 * 0.5**0.9)
        trainer.images = 400
        self.assertEqual(trainer.rate(), 0)


class AverageTest(unittest.TestCase):
    def test_it_follows(self):
        network = torch.nn.Linear(1, 1)
        average = Average(network, decay=0.5)
        with torch.no_grad():
            network.weight.fill_(8)
            for _ in range(60):
                average.update(network)
        self.assertAlmostEqual(float(average.network.weight), 8, 4)


if __name__ == "__main__":
    unittest.main()
