"""Reading and writing of .safetensors files with numpy arrays.

Layout: u64 little-endian length of the header, JSON header, then the data of all tensors
(https://huggingface.co/docs/safetensors). Written with sorted names and a header padded to
8 bytes, so that the same tensors always give the same bytes.
"""

import json
import os
import struct
import zlib

import numpy as np

_NAMES = {np.dtype("float32"): "F32", np.dtype("float16"): "F16", np.dtype("int8"): "I8",
          np.dtype("uint8"): "U8", np.dtype("int64"): "I64"}
# What a file of this format holds in "format"; it must have its checksum. Else a damaged name of the
# checksum's entry would be taken for a file of another program.
CHECKED_FORMAT = "stdc-weights-2"
_TYPES = {name: dtype for dtype, name in _NAMES.items()}


def write(path, tensors, metadata=None):
    """Write {name: array} and {string: string}; the file appears whole or not at all."""
    header, offset, chunks = {}, 0, []
    header["__metadata__"] = dict(sorted({**(metadata or {}), "crc32": "0" * 8}.items()))
    for name in sorted(tensors):
        array = np.ascontiguousarray(tensors[name])
        if array.dtype not in _NAMES:
            raise ValueError(f"{name}: type {array.dtype} cannot be written; convert it to float32")
        end = offset + array.nbytes
        header[name] = {"dtype": _NAMES[array.dtype], "shape": list(array.shape),
                        "data_offsets": [offset, end]}
        chunks.append(array.tobytes())
        offset = end
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 8)
    text = with_checksum(text, chunks)
    partial = f"{path}.partial"
    with open(partial, "wb") as file:
        file.write(struct.pack("<Q", len(text)))
        file.write(text)
        file.writelines(chunks)
    os.replace(partial, path)


def with_checksum(header, chunks):
    """The header with its entry "crc32": of the whole file, with zeros in place of the digits."""
    checksum = zlib.crc32(struct.pack("<Q", len(header)) + header)
    for chunk in chunks:
        checksum = zlib.crc32(chunk, checksum)
    return header.replace(b'"crc32":"00000000"', b'"crc32":"%08x"' % checksum, 1)


def read(path):
    """Return ({name: array}, {string: string}) of a file."""
    with open(path, "rb") as file:
        data = file.read()
    if len(data) < 8:
        raise ValueError(f"{path}: too short for a safetensors file")
    length = struct.unpack_from("<Q", data)[0]
    if length > len(data) - 8:
        raise ValueError(f"{path}: the header of {length} bytes is longer than the file")
    header = json.loads(data[8:8 + length])
    metadata = header.pop("__metadata__", {})
    written = metadata.pop("crc32", None)
    if written is None and metadata.get("format") == CHECKED_FORMAT:
        raise ValueError(f"{path}: the file is damaged (it has lost its checksum)")
    if written is not None:
        zeros = data[8:8 + length].replace(b'"crc32":"%s"' % written.encode(), b'"crc32":"00000000"', 1)
        if with_checksum(zeros, [data[8 + length:]]) != data[8:8 + length]:
            raise ValueError(f"{path}: the file is damaged (its checksum is wrong)")
    tensors = {}
    for name, entry in header.items():
        try:
            begin, end = entry["data_offsets"]
            dtype, shape = _TYPES[entry["dtype"]], entry["shape"]
        except (KeyError, TypeError, ValueError) as error:
            raise ValueError(f"{path}: the entry {name!r} of its header is damaged") from error
        array = np.frombuffer(data[8 + length + begin:8 + length + end], dtype)
        tensors[name] = array.reshape(shape)
    return tensors, metadata
