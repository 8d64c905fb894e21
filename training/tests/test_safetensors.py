"""Weights files: round trip, same bytes, checksum, bad files. Needs numpy alone."""

import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

from stdc_training import safetensors, seal

REPOSITORY = Path(__file__).resolve().parents[2]
# What the program's own tests read.
TINY = REPOSITORY / "src/segmentation/network/testdata/tiny.safetensors"


class SafetensorsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "x.safetensors")

    def test_round_trip(self):
        tensors = {"b": np.arange(6, dtype=np.float32).reshape(2, 3),
                   "a": np.float16([[1.5]]), "empty": np.zeros((0, 4), np.int8)}
        safetensors.write(self.path, tensors, {"z": "1", "key": "ä"})
        found, metadata = safetensors.read(self.path)
        self.assertEqual(metadata, {"z": "1", "key": "ä"})
        for name, array in tensors.items():
            self.assertEqual(found[name].dtype, array.dtype)
            np.testing.assert_array_equal(found[name], array)

    def test_same_bytes_whatever_the_order(self):
        one, two = np.ones(3, np.float32), np.zeros(2, np.float32)
        safetensors.write(self.path, {"one": one, "two": two})
        first = Path(self.path).read_bytes()
        safetensors.write(self.path, {"two": two, "one": one})
        self.assertEqual(first, Path(self.path).read_bytes())

    def test_bad_files_and_types(self):
        with self.assertRaisesRegex(ValueError, "float64"):
            safetensors.write(self.path, {"x": np.zeros(1)})
        for data in (b"", b"\xff" * 8 + b"{}"):
            with open(self.path, "wb") as file:
                file.write(data)
            with self.assertRaises(ValueError):
                safetensors.read(self.path)

    def test_the_programs_files_are_written_the_same(self):
        for path in (TINY, REPOSITORY / "models/stdc1-person-wide.safetensors",
                     REPOSITORY / "models/stdc1-person-slim.safetensors"):
            safetensors.write(self.path, *safetensors.read(path))
            self.assertEqual(Path(self.path).read_bytes(), path.read_bytes(), path.name)

    def test_every_flipped_bit_is_noticed(self):
        safetensors.write(self.path, {"t": np.float32([1.5, -2])},
                          {"key": "value", "format": safetensors.CHECKED_FORMAT})
        good = Path(self.path).read_bytes()
        form = good.index(b'"format"')
        for at in range(len(good)):
            if form <= at < form + len(b'"format":"stdc-weights-2"'):
                continue  # weights.load refuses what is of no format that it knows
            for bit in range(8):
                bad = bytearray(good)
                bad[at] ^= 1 << bit
                Path(self.path).write_bytes(bad)
                with self.assertRaises(ValueError, msg=f"byte {at} bit {bit}"):
                    safetensors.read(self.path)

    def test_damage_is_named(self):
        safetensors.write(self.path, {"t": np.float32([1.5, -2])})
        bad = bytearray(Path(self.path).read_bytes())
        bad[-1] ^= 1
        Path(self.path).write_bytes(bad)
        with self.assertRaisesRegex(ValueError, "checksum"):
            safetensors.read(self.path)

    def test_an_older_file_is_sealed(self):
        safetensors.write(self.path, {"t": np.float32([1.5, -2])}, {"format": "stdc-weights-1"})
        old = Path(self.path).read_bytes()
        seal.seal(self.path, [("scores", "none")])
        tensors, metadata = safetensors.read(self.path)
        self.assertEqual(metadata, {"format": "stdc-weights-2", "scores": "none"})
        self.assertEqual(Path(self.path).read_bytes()[-8:], old[-8:])
        np.testing.assert_array_equal(tensors["t"], np.float32([1.5, -2]))


if __name__ == "__main__":
    unittest.main()
