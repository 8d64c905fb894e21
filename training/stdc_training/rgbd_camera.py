"""What the colour pictures of RGB-D cameras (Kinect, RealSense) look like, for photos."""

import cv2
import numpy as np

_MOSAICS = (cv2.COLOR_BayerBG2BGR, cv2.COLOR_BayerGB2BGR, cv2.COLOR_BayerRG2BGR,
            cv2.COLOR_BayerGR2BGR)


def rgbd_camera(rng, image):
    """A changed copy of a uint8 RGB image [h, w, 3]: light, exposure, sensor, compression.

    In the order of a camera: stray light, exposure (mostly too long) and white balance, vignetting,
    noise that grows with the light, the mosaic of colour filters, sharpening, JPEG.
    """
    values = image.astype(np.float32)
    flare = rng.uniform(0, 45) if rng.random() < 0.5 else 0.0
    values = flare + values * (1 - flare / 255)
    gain = np.exp(rng.normal(0.12, 0.35)) * np.exp(rng.normal(0, 0.07, 3))
    values *= gain.astype(np.float32)
    if rng.random() < 0.3:
        values *= _vignette(rng, image.shape)
    if rng.random() < 0.7:
        values += _noise(rng, values)
    image = np.clip(values, 0, 255).astype(np.uint8)
    if rng.random() < 0.5:
        image = _mosaic(rng, image)
    if rng.random() < 0.3:
        soft = cv2.GaussianBlur(image, (0, 0), rng.uniform(0.8, 1.5))
        amount = rng.uniform(0.3, 1.2)
        image = cv2.addWeighted(image, 1 + amount, soft, -amount, 0)
    if rng.random() < 0.6:
        _, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, int(rng.integers(75, 96))])
        image = cv2.imdecode(data, cv2.IMREAD_COLOR)
    return image


def _vignette(rng, shape):
    """Gain [h, w, 1] that falls towards the corners."""
    height, width = shape[:2]
    y, x = np.ogrid[-1:1:height * 1j, -1:1:width * 1j]
    return (1 - rng.uniform(0.05, 0.25) * (x**2 + y**2))[..., None].astype(np.float32)


def _noise(rng, values):
    """Of the read-out, and of the photons: its variance grows with the light."""
    height, width = values.shape[:2]
    deviation = np.sqrt(rng.uniform(0, 5) ** 2 + rng.uniform(0, 0.25) * np.clip(values, 0, 255))
    noise = rng.standard_normal((height, width, 3), np.float32)
    if rng.random() < 0.4:  # as coarse as a camera's own noise filter leaves it
        noise = cv2.GaussianBlur(noise, (0, 0), 0.8) * 2
    return (noise * deviation).astype(np.float32)


def _mosaic(rng, image):
    """One colour at each pixel and the others interpolated: false colours at fine edges."""
    height, width = image.shape[:2]
    order = int(rng.integers(4))
    mosaic = image[..., 1].copy()
    red, blue = ((1, 1), (0, 0)), ((0, 0), (1, 1))
    places = {0: (red[0], blue[0]), 2: (red[1], blue[1]), 1: ((1, 0), (0, 1)), 3: ((0, 1), (1, 0))}
    for channel, (row, column) in zip((0, 2), places[order]):
        mosaic[row::2, column::2] = image[row::2, column::2, channel]
    return cv2.cvtColor(mosaic, _MOSAICS[order])
