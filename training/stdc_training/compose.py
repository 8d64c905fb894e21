"""People cut out of photos and pasted onto frames of rooms where nobody is."""

import cv2
import numpy as np

from .views import affine, log_uniform, seen_part, warp

# Height of the camera over the height of a standing person: with it the horizon and the
# person's height in the picture tell where the feet are.
CAMERA_SHARE = 0.74


def compose(rng, frame, cutouts, size, heights=(0.3, 2.6), downward=0.0, low=0.0):
    """Paste each cutout (entry, packed image) onto the RGB frame; return (image, label).

    Small, that is distant, people first, so that near ones hide them. Their heights
    are within `heights` of the frame's. downward: how many are seen by a camera that looks down,
    on a desk say, without their heads; low: how many frames are seen from below 1.3 m.
    """
    label = np.zeros(frame.shape[:2], np.uint8)
    horizon = rng.uniform(0.3, 0.65)
    camera = rng.uniform(0.2, CAMERA_SHARE) if low and rng.random() < low else CAMERA_SHARE
    heights = np.sort([log_uniform(rng, *heights) for _ in cutouts])
    for (entry, image), height in zip(cutouts, heights):
        frame, label = paste(rng, frame, label, entry, image, (height, horizon, camera), size,
                             downward)
    return frame, label


def paste(rng, frame, label, entry, image, place, size, downward=0.0):
    """Paste one person of `place` = (height, horizon) in shares of the frame's height, and the
    camera's height in shares of the person's."""
    width, height = size
    share, horizon, camera = place
    x0, y0, x1, y1 = entry["box"]
    bottom = horizon + camera * share + rng.normal(0, 0.08)
    way = rng.random()
    if way < 0.25:  # seated, crouching, on a step: the head at any height
        bottom = share + rng.uniform(-0.1, 0.6)
    elif way > 1 - downward:  # the head is above the frame
        bottom = share * rng.uniform(0.25, 0.85)
    if y1 >= entry["shape"][0] - 2:  # cut off by the photo: the frame has to cut it off too
        bottom = max(bottom, 1.0)
    source_height = (y1 - y0) / share
    across = rng.uniform(-0.05, 1.05)
    if x0 <= 1 or x1 >= entry["shape"][1] - 1:
        across = rng.choice([0.0, 1.0]) if share < 1 else across
    centre_x = (x0 + x1) / 2 + (0.5 - across) * source_height * width / height
    centre_y = y1 + (0.5 - bottom) * source_height
    matrix = affine((centre_x, centre_y), source_height, size, rng.normal(0, 0.05),
                    log_uniform(rng, 0.88, 1.12), rng.random() < 0.5)
    colour, alpha = _warped_cutout(image, matrix, size)
    alpha = cv2.GaussianBlur(alpha, (0, 0), rng.uniform(0.5, 1.1))
    x, y, w, h = cv2.boundingRect(alpha)
    area = (slice(y, y + h), slice(x, x + w))
    # A little inwards: less of the old background.
    alpha = np.clip((alpha[area].astype(np.float32) / 255 - 0.15) / 0.7, 0, 1)
    inside = alpha > 0.5
    if not inside.any():
        return frame, label
    pasted = harmonised(rng, colour[area], inside, frame)
    frame[area] = (frame[area] + alpha[..., None] * (pasted - frame[area])).astype(np.uint8)
    label[area][inside] = 1
    return frame, label


def _warped_cutout(image, matrix, size):
    """Colour and coverage (0..255) of the person of a packed image."""
    colour, _ = warp(image, matrix, size, cv2.BORDER_REPLICATE)
    part, matrix = seen_part(image[..., 3], matrix, size, 2)
    return colour, cv2.warpAffine((part == 1).astype(np.uint8) * 255, matrix, size,
                                  flags=cv2.WARP_INVERSE_MAP | cv2.INTER_LINEAR,
                                  borderMode=cv2.BORDER_CONSTANT)


def harmonised(rng, colour, inside, frame):
    """The person's colours brought part of the way to the frame's light; float32."""
    person = colour[inside].mean() + 1
    gain = np.clip((frame.mean() + 1) / person, 0.4, 2.0) ** rng.uniform(0.2, 0.9)
    gain *= np.exp(rng.normal(0, 0.1)) * np.exp(rng.normal(0, 0.04, 3))
    return np.clip(colour * gain.astype(np.float32), 0, 255).astype(np.float32)


def hide(rng, image, label, other):
    """Cover part of the people with a piece of another frame, or with one colour: furniture or the
    back of a monitor in front of them."""
    height, width = label.shape
    if rng.random() < 0.3:
        other = np.full_like(image, rng.integers(0, 256)) if rng.random() < 0.4 else other // 8
    mask = np.zeros((height, width), np.uint8)
    if rng.random() < 0.5:  # a desk: everything below a sloping line
        left, right = height * rng.uniform(0.5, 1.0, 2)
        corners = [(0, left), (width, right), (width, height), (0, height)]
    else:  # a cabinet, a monitor, a door frame
        w, h = width * rng.uniform(0.08, 0.4), height * rng.uniform(0.15, 0.7)
        x, y = rng.uniform(-0.1, 1) * width, rng.uniform(0.2, 1) * height
        h = height - y if rng.random() < 0.3 else h  # it stands on a desk, or on the floor
        corners = np.array([(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
        corners = corners + rng.normal(0, 0.03 * width, (4, 2))
    cv2.fillConvexPoly(mask, np.int32(np.round(corners)), 1)
    hidden = mask.astype(bool)
    image[hidden] = other[hidden]
    label[hidden] = 0
    return image, label
