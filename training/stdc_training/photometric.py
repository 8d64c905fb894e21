"""Random changes of colour and sharpness: what cameras and their compression do."""

import cv2
import numpy as np


def distort(rng, image, strength=1.0):
    """A changed copy of a uint8 RGB image [h, w, 3]; strength 0 changes nothing, 1 a lot."""
    if rng.random() < 0.85 * strength**0.5:
        image = tone(rng, image, strength)
    if rng.random() < 0.1 * strength:
        grey = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)
        image = cv2.cvtColor(grey, cv2.COLOR_GRAY2RGB)
    if rng.random() < 0.25 * strength:
        image = blur(rng, image)
    if rng.random() < 0.35 * strength:
        channels = 1 if rng.random() < 0.3 else 3
        noise = rng.standard_normal((*image.shape[:2], channels), np.float32) * rng.uniform(1, 9)
        image = np.clip(image + noise.astype(np.float32), 0, 255).astype(np.uint8)
    if rng.random() < 0.25 * strength:
        quality = int(rng.integers(30, 95))
        _, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])
        image = cv2.imdecode(data, cv2.IMREAD_COLOR)
    return image


def tone(rng, image, strength):
    """Exposure, contrast, white balance, saturation and gamma, by tables and one small matrix."""
    gain = np.exp(rng.normal(0, 0.1 * strength, 3)) * np.exp(rng.normal(0, 0.2 * strength))
    contrast, middle = np.exp(rng.normal(0, 0.2 * strength)), rng.uniform(90, 150)
    gamma = np.exp(rng.normal(0, 0.2 * strength))
    levels = 255 * (np.arange(256) / 255) ** gamma
    tables = np.clip((levels[:, None] * gain - middle) * contrast + middle, 0, 255)
    image = cv2.LUT(image, tables.astype(np.uint8)[None])
    keep = float(np.clip(rng.normal(1, 0.35 * strength), 0, 2))
    weights = np.array([0.299, 0.587, 0.114])
    return cv2.transform(image, keep * np.eye(3) + (1 - keep) * np.tile(weights, (3, 1)))


def blur(rng, image):
    """Out of focus, moved during the exposure, or taken at a lower resolution."""
    kind = rng.integers(3)
    if kind == 0:
        return cv2.GaussianBlur(image, (0, 0), rng.uniform(0.4, 1.6))
    if kind == 1:
        length = int(rng.integers(2, 8))
        kernel = np.zeros((2 * length + 1,) * 2, np.float32)
        angle = rng.uniform(0, np.pi)
        reach = np.array([np.cos(angle), np.sin(angle)]) * length / 2
        ends = [tuple(int(round(v)) for v in length + sign * reach) for sign in (-1, 1)]
        cv2.line(kernel, ends[0], ends[1], 1.0)
        return cv2.filter2D(image, -1, kernel / kernel.sum())
    height, width = image.shape[:2]
    scale = rng.uniform(0.4, 0.9)
    size = int(width * scale), int(height * scale)
    small = cv2.resize(image, size, interpolation=cv2.INTER_AREA)
    return cv2.resize(small, (width, height), interpolation=cv2.INTER_LINEAR)
