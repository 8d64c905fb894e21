"""Tests of the training package: `python3 -m unittest` in training/.

They need PyTorch, numpy and OpenCV (Debian: python3-torch python3-numpy python3-opencv) and are
skipped, saying so, where one of them is absent.
"""

import unittest

try:
    import cv2  # noqa: F401
    import numpy  # noqa: F401
    import torch

    torch.set_num_threads(1)
except ImportError as error:
    raise unittest.SkipTest(f"skipped: {error}; apt-get install python3-torch python3-opencv")
