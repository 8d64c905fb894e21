"""Writes ROS 1 bags by ROS's own writer (Debian's python3-rosbag and python3-*-msgs)."""
import importlib

import genpy
import rosbag

_UPPER = {"d": "D", "k": "K", "r": "R", "p": "P"}


def message_of(kind, fields):
    package, name = kind.split("/")
    message = getattr(importlib.import_module(package + ".msg"), name)()
    fill(message, fields)
    return message


def fill(message, fields):
    for key, value in fields.items():
        if isinstance(message, genpy.Message) and message._type == "sensor_msgs/CameraInfo":
            key = _UPPER.get(key, key)
        if key == "stamp":
            message.stamp = genpy.Time(value["sec"], value["nanosec"])
        elif isinstance(value, dict):
            fill(getattr(message, key), value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            kind = dict(zip(message.__slots__, message._get_types()))[key].rstrip("[]")
            setattr(message, key, [message_of(kind, item) for item in value])
        else:
            setattr(message, key, value)


def serialised(kind, fields):
    import io
    buffer = io.BytesIO()
    message_of(kind, fields).serialize(buffer)
    return buffer.getvalue()


def definition_of(kind):
    package, name = kind.split("/")
    return getattr(importlib.import_module(package + ".msg"), name)._full_text


def write_bag(path, messages, compression="none", chunk_bytes=768 * 1024):
    """compression: none, bz2 or lz4"""
    with rosbag.Bag(str(path), "w", compression=compression, chunk_threshold=chunk_bytes) as bag:
        for time, topic, kind, fields in messages:
            bag.write(topic, message_of(kind, fields), genpy.Time(time // 10**9, time % 10**9))
