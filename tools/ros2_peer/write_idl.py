#!/usr/bin/env python3
"""Writes an .idl of ROS 2's messages from the .msg files of Debian's ros-*-msgs packages.

Usage: write_idl.py OUTPUT.idl PACKAGE/MESSAGE...   (messages that these need are added)

The names are those that ROS 2 gives its types on the wire (sensor_msgs::msg::dds_::Image_). Debian's files are of ROS 1;
three things differ: ROS 2 has no `seq` in its header, `time` and `duration` are messages of builtin_interfaces, and an
empty message holds one byte.
"""
import pathlib
import re
import sys

SHARE = pathlib.Path("/usr/share")
BASIC = {
    "bool": "boolean", "byte": "octet", "char": "uint8", "int8": "int8", "uint8": "uint8", "int16": "int16",
    "uint16": "uint16", "int32": "int32", "uint32": "uint32", "int64": "int64", "uint64": "uint64", "float32": "float",
    "float64": "double", "string": "string",
}
TIME = "builtin_interfaces/Time"


def fields_of(package, message):
    """(type, array, name) of each field; array is None, "" or a length."""
    if f"{package}/{message}" == TIME:
        return [("int32", None, "sec"), ("uint32", None, "nanosec")]
    fields = []
    for line in (SHARE / package / "msg" / f"{message}.msg").read_text().splitlines():
        line = line.split("#")[0].strip()
        if not line or "=" in line:  # constants are not sent
            continue
        kind, array, name = re.fullmatch(r"([\w/]+)(?:\[(\d*)\])?\s+(\w+)", line).groups()
        if (package, message, name) == ("std_msgs", "Header", "seq"):
            continue
        if kind in ("time", "duration"):
            kind = TIME
        elif kind == "Header":
            kind = "std_msgs/Header"
        elif kind not in BASIC and "/" not in kind:
            kind = f"{package}/{kind}"
        fields.append((kind, array, name))
    return fields or [("uint8", None, "structure_needs_at_least_one_member")]


def name_on_the_wire(kind):
    if kind in BASIC:
        return BASIC[kind]
    package, message = kind.split("/")
    return f"{package}::msg::dds_::{message}_"


def declaration(kind, array, name):
    base = name_on_the_wire(kind)
    if array is None:
        return f"{base} {name}_;"
    return f"sequence<{base}> {name}_;" if array == "" else f"{base} {name}_[{array}];"


def write(full_name, done, lines):
    if full_name in done:
        return
    done.add(full_name)
    package, message = full_name.split("/")
    fields = fields_of(package, message)
    for kind, _, _ in fields:
        if kind not in BASIC:
            write(kind, done, lines)
    lines.append(f"module {package} {{ module msg {{ module dds_ {{\n@final struct {message}_ {{")
    lines += [f"  {declaration(*field)}" for field in fields]
    lines.append("};\n}; }; };\n")


def main():
    done, lines = set(), []
    for full_name in sys.argv[2:]:
        write(full_name, done, lines)
    pathlib.Path(sys.argv[1]).write_text("\n".join(lines))


main()
