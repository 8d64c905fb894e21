"""Import it first in a test module that needs PyTorch or OpenCV: without them it is skipped."""

import unittest

try:
    import cv2  # noqa: F401
    import torch

    torch.set_num_threads(1)
except ImportError as error:
    raise unittest.SkipTest(f"{error}; apt-get install python3-torch python3-opencv")
