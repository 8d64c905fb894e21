"""Views of packed images: a random crop, scale, turn and mirroring as one affine warp.

A view maps output pixels (x, y) to source pixels by a 2x3 matrix. Sizes are (width, height).
"""

import cv2
import numpy as np

# More enlargement than this shows nothing but blur.
LARGEST_ENLARGEMENT = 3.0


def log_uniform(rng, low, high):
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def affine(centre, source_height, size, angle=0.0, stretch=1.0, mirror=False):
    """2x3 matrix of the view whose middle is `centre` in the source.

    source_height: height of the view in source pixels; stretch: horizontal factor; angle: rad.
    """
    width, height = size
    scale = source_height / height
    c, s = np.cos(angle) * scale, np.sin(angle) * scale
    across = -stretch if mirror else stretch
    linear = np.array([[c * across, -s], [s * across, c]])
    offset = np.asarray(centre) - linear @ np.array([(width - 1) / 2, (height - 1) / 2])
    return np.column_stack([linear, offset])


def seen_part(image, matrix, size, margin):
    """The part of an image [h, w, ...] that a view needs, `margin` around it, and its matrix."""
    width, height = size
    corners = matrix @ np.array([[0, width, 0, width], [0, 0, height, height], [1] * 4])
    low = np.floor(corners.min(1)).astype(int) - margin
    high = np.ceil(corners.max(1)).astype(int) + margin + 1
    parts = []
    for begin, end, length in zip(low, high, image.shape[1::-1]):
        begin = int(np.clip(begin, 0, length - 2))
        parts.append(slice(begin, int(np.clip(end, begin + 2, length))))
    columns, rows = parts
    return image[rows, columns], matrix - np.array([[0, 0, columns.start], [0, 0, rows.start]])


def warp(image, matrix, size, border=cv2.BORDER_REFLECT_101, grey=0):
    """Colour [h, w, 3] and label [h, w] of a view of a packed [h, w, 4] image.

    With cv2.BORDER_CONSTANT what lies outside the image is `grey` and its label unknown.
    Strong shrinking is preceded by a blur, because bilinear sampling alone would alias.
    """
    scale = np.sqrt(abs(np.linalg.det(matrix[:, :2])))
    image, matrix = seen_part(image, matrix, size, 2 + int(2 * scale))
    colour = np.ascontiguousarray(image[..., :3])
    label = np.ascontiguousarray(image[..., 3])
    if scale > 1.3:
        colour = cv2.GaussianBlur(colour, (0, 0), 0.4 * scale)
    flags = cv2.WARP_INVERSE_MAP
    return (
        cv2.warpAffine(colour, matrix, size, flags=flags | cv2.INTER_LINEAR, borderMode=border,
                       borderValue=(grey,) * 3),
        cv2.warpAffine(label, matrix, size, flags=flags | cv2.INTER_NEAREST, borderMode=border,
                       borderValue=255),
    )


def _pose(rng):
    angle = rng.uniform(-0.6, 0.6) if rng.random() < 0.08 else rng.normal(0, 0.07)
    return {"angle": angle, "stretch": log_uniform(rng, 0.85, 1.18),
            "mirror": rng.random() < 0.5}


def _limited_height(wanted, shape, size):
    """The wanted view height, bounded by enlargement and by how much lies outside the source."""
    height, width = shape
    aspect = size[0] / size[1]
    widest = min(1.3 * height, 1.7 * width / aspect)
    return float(np.clip(wanted, size[1] / LARGEST_ENLARGEMENT, max(widest, 16)))


def person_view(rng, entry, size, heights=(0.35, 3.0)):
    """A view by the person's height in it, which is within `heights` of the frame's."""
    x0, y0, x1, y1 = entry["box"]
    wanted = (y1 - y0) / log_uniform(rng, *heights)
    source_height = _limited_height(wanted, entry["shape"], size)
    centre = (x0 + (x1 - x0) * rng.uniform(-0.1, 1.1), y0 + (y1 - y0) * rng.beta(1.5, 2.0))
    centre = _kept_inside(centre, source_height, entry["shape"], size, 0.15)
    return affine(centre, source_height, size, **_pose(rng))


def scene_view(rng, entry, size, largest=1.15):
    """A view of any part of the image."""
    height, width = entry["shape"]
    fitting = min(height, width * size[1] / size[0])
    source_height = max(fitting * log_uniform(rng, 0.4, largest), size[1] / LARGEST_ENLARGEMENT)
    centre = (rng.uniform(0, width), rng.uniform(0, height))
    centre = _kept_inside(centre, source_height, entry["shape"], size, 0.1)
    return affine(centre, source_height, size, **_pose(rng))


def whole_view(rng, entry, size):
    """A view of the whole image, with margins where its shape is another."""
    height, width = entry["shape"]
    source_height = max(height, width * size[1] / size[0]) * rng.uniform(1.0, 1.1)
    return affine((width / 2, height / 2), source_height, size, mirror=rng.random() < 0.5)


def _kept_inside(centre, source_height, shape, size, overhang):
    """Move a view so that at most `overhang` of it lies outside the source, if it can."""
    moved = []
    extents = (source_height * size[0] / size[1], source_height)
    for value, extent, length in zip(centre, extents, (shape[1], shape[0])):
        margin = extent * (0.5 - overhang)
        moved.append(np.clip(value, margin, length - margin) if 2 * margin < length else length / 2)
    return moved
