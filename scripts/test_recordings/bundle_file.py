"""Writes messages to files that write_mcap.mjs reads: BUNDLE.jsonl, BUNDLE.bin, BUNDLE.definitions.json."""
import json


def write_bundle(path, messages):
    from write_bag import definition_of, serialised
    definitions = {}
    with open(f"{path}.bin", "wb") as data, open(f"{path}.jsonl", "w") as lines:
        def put(content):
            at = data.tell()
            data.write(content)
            return [at, len(content)]

        def plain(value):
            if isinstance(value, bytes):
                return {"$bytes": put(value)}
            if isinstance(value, dict):
                return {key: plain(item) for key, item in value.items()}
            if isinstance(value, list):
                return [plain(item) for item in value]
            return value

        for time, topic, kind, fields in messages:
            definitions[kind] = definition_of(kind)
            line = {"topic": topic, "type": kind, "time": str(time), "ros1": put(serialised(kind, fields)),
                    "fields": plain(fields)}
            lines.write(json.dumps(line) + "\n")
    with open(f"{path}.definitions.json", "w") as file:
        json.dump(definitions, file)
