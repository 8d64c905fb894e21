"""Write a weights file again with its checksum: python3 -m stdc_training.seal FILE [--set NAME=TEXT].

The numbers stay as they are, byte for byte; --set changes entries of the metadata. A file whose
checksum is wrong is refused. Needs numpy alone.
"""

import argparse

from . import safetensors


def seal(path, changes=()):
    """Write the file again in the format that must have a checksum; changes: [(name, text)]."""
    tensors, metadata = safetensors.read(path)
    metadata.update(dict(changes), format=safetensors.CHECKED_FORMAT)
    safetensors.write(path, tensors, metadata)


def _entry(text):
    name, equals, value = text.partition("=")
    if not name or not equals or name in ("crc32", "format"):
        raise argparse.ArgumentTypeError(f"{text!r}: give NAME=TEXT, and neither crc32 nor format")
    return name, value


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument("--set", type=_entry, action="append", default=[], metavar="NAME=TEXT",
                        help="entry of the metadata; may be repeated")
    options = parser.parse_args()
    seal(options.file, options.set)


if __name__ == "__main__":
    main()
