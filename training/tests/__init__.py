"""Tests of the training package: `python3 -m unittest` in training/.

All need numpy; those that begin with `from . import with_torch` need PyTorch and OpenCV too
(Debian: python3-torch python3-numpy python3-opencv) and are skipped, saying so, without them.
"""
