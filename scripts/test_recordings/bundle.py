"""Turns a sequence in TUM layout into messages as a robot's camera would publish them.

A message is a dictionary: topic, type, time (ns) and fields, in the names of ROS 2."""
import math
import pathlib

import numpy
from PIL import Image

COLOUR, DEPTH = "/camera/color", "/camera/aligned_depth_to_color"
FRAME = "camera_color_optical_frame"


def read_list(path):
    """(time in ns, the other words) of each line."""
    rows = []
    for line in path.read_text().splitlines():
        words = line.split("#")[0].split()
        if words:
            seconds, _, digits = words[0].partition(".")
            rows.append((int(seconds) * 10**9 + int(digits.ljust(9, "0")[:9]), words[1:]))
    return rows


def read_camera(folder):
    camera = {"depth_units_per_metre": "5000", "k1": 0, "k2": 0, "p1": 0, "p2": 0, "k3": 0}
    for line in (folder / "camera.yaml").read_text().splitlines():
        key, _, value = line.split("#")[0].partition(":")
        if value.strip():
            camera[key.strip()] = value.strip()
    return camera


def header(time, frame=FRAME):
    return {"stamp": {"sec": time // 10**9, "nanosec": time % 10**9}, "frame_id": frame}


def camera_info(camera, time):
    fx, fy, cx, cy = (float(camera[key]) for key in ("fx", "fy", "cx", "cy"))
    return {
        "header": header(time), "height": int(camera["height"]), "width": int(camera["width"]),
        "distortion_model": "plumb_bob", "d": [float(camera[key]) for key in ("k1", "k2", "p1", "p2", "k3")],
        "k": [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0], "r": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "p": [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0], "binning_x": 0, "binning_y": 0,
        "roi": {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}}


def raw_image(pixels, encoding, time):
    height, width = pixels.shape[:2]
    return {"header": header(time), "height": height, "width": width, "encoding": encoding, "is_bigendian": 0,
            "step": pixels.nbytes // height, "data": pixels.tobytes()}


def transform(time, parent, child, translation):
    x, y, z = translation
    return {"header": header(time, parent), "child_frame_id": child,
            "transform": {"translation": {"x": x, "y": y, "z": z}, "rotation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}}}


def pose(time, words):
    x, y, z, qx, qy, qz, qw = (float(word) for word in words[:7])
    return {"header": header(time, "world"), "pose": {"position": {"x": x, "y": y, "z": z},
                                                      "orientation": {"x": qx, "y": qy, "z": qz, "w": qw}}}


class Sequence:
    def __init__(self, folder, frames=None):
        self.folder = pathlib.Path(folder)
        self.camera = read_camera(self.folder)
        self.colour = read_list(self.folder / "rgb.txt")[:frames]
        self.depth = read_list(self.folder / "depth.txt")[:frames]
        truth = self.folder / "groundtruth.txt"
        self.truth = read_list(truth) if truth.exists() else []
        if frames:
            self.truth = [row for row in self.truth if row[0] <= self.depth[-1][0] + 10**9]

    def millimetres(self, file):
        """A depth image as ROS has it. Raises ValueError if that would round."""
        stored = numpy.array(Image.open(self.folder / file)).astype(numpy.float64)
        scaled = stored * 1000 / float(self.camera["depth_units_per_metre"])
        if (scaled != numpy.round(scaled)).any():
            raise ValueError("a depth is no whole number of millimetres: render with depth_units_per_metre 1000")
        return scaled.astype(numpy.uint16)

    def images(self, style):
        """style: raw (rgb8, 16UC1), bgr-float (bgr8, 32FC1), png (as stored), jpeg-inverse (JPEG, inverse depth)."""
        for time, words in self.colour:
            yield time, self.colour_message(style, time, words[0])
        for time, words in self.depth:
            yield time, self.depth_message(style, time, words[0])

    def colour_message(self, style, time, file):
        path = self.folder / file
        if style in ("png", "jpeg-inverse"):
            data = path.read_bytes()
            if style == "jpeg-inverse":
                import io
                buffer = io.BytesIO()
                Image.open(path).convert("RGB").save(buffer, "JPEG", quality=90)
                data = buffer.getvalue()
            codec = "png" if style == "png" else "jpeg"
            return (f"{COLOUR}/image_raw/compressed", "sensor_msgs/CompressedImage",
                    {"header": header(time), "format": f"rgb8; {codec} compressed bgr8", "data": data})
        pixels = numpy.array(Image.open(path).convert("RGB"))
        if style == "bgr-float":
            return f"{COLOUR}/image_raw", "sensor_msgs/Image", raw_image(pixels[:, :, ::-1].copy(), "bgr8", time)
        return f"{COLOUR}/image_raw", "sensor_msgs/Image", raw_image(pixels, "rgb8", time)

    def depth_message(self, style, time, file):
        topic = f"{DEPTH}/image_raw"
        millimetres = self.millimetres(file)
        if style == "raw":
            return topic, "sensor_msgs/Image", raw_image(millimetres, "16UC1", time)
        metres = (millimetres / 1000).astype(numpy.float32)
        if style == "bgr-float":
            return topic, "sensor_msgs/Image", raw_image(metres, "32FC1", time)
        parameters, kind = numpy.zeros(3, numpy.float32), "16UC1"
        if style == "jpeg-inverse":
            # depth = a / (value - b), as compressed_depth_image_transport has it
            quantum, maximum = 100.0, 10.0
            a = quantum * (quantum + 1)
            b = 1 - a / maximum
            parameters[1:], kind = (a, b), "32FC1"
            with numpy.errstate(divide="ignore"):
                inverse = numpy.where(metres > 0, a / metres + b, 0)
            millimetres = inverse.astype(numpy.uint16)
        import io
        buffer = io.BytesIO()
        Image.fromarray(millimetres).save(buffer, "PNG")
        return (f"{topic}/compressedDepth", "sensor_msgs/CompressedImage",
                {"header": header(time), "format": f"{kind}; compressedDepth png",
                 "data": parameters.tobytes() + buffer.getvalue()})

    def messages(self, style):
        """All messages in order of time: (time, topic, type, fields)."""
        first = self.colour[0][0]
        result = [(first - 10**7, "/tf_static", "tf2_msgs/TFMessage",
                   {"transforms": [transform(first, "camera_link", FRAME, (0.0, 0.0, 0.0))]})]
        for time, _ in self.colour:
            result.append((time, f"{COLOUR}/camera_info", "sensor_msgs/CameraInfo", camera_info(self.camera, time)))
        result += [(time, *message) for time, message in self.images(style)]
        result += [(time, "/ground_truth/pose", "geometry_msgs/PoseStamped", pose(time, words))
                   for time, words in self.truth]
        return sorted(result, key=lambda message: (message[0], message[1]))
