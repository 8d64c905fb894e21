"""Writes folders of rosbag2's SQLite storage by Python's sqlite3, with CDR from elsewhere; tables as rosbag2 makes them."""
import pathlib
import sqlite3
import subprocess


def packed(content):
    return subprocess.run(["zstd", "-q", "-c"], input=content, stdout=subprocess.PIPE, check=True).stdout


def write_file(path, messages, cdr, topics, pack_messages=False):
    path.unlink(missing_ok=True)
    database = sqlite3.connect(path)
    database.executescript(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
        " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,"
        " data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC);")
    for number, (name, kind) in enumerate(topics, 1):
        database.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", (number, name, kind.replace("/", "/msg/")))
    numbers = {name: number for number, (name, _) in enumerate(topics, 1)}
    for (time, topic, _, _), content in zip(messages, cdr):
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
                         (numbers[topic], time, packed(content) if pack_messages else content))
    database.commit()
    database.close()


def write_folder(folder, messages, cdr, parts=1, compression=""):
    """compression: "", "FILE" or "MESSAGE" (by the zstd program)"""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    topics = sorted({(topic, kind) for _, topic, kind, _ in messages})
    files = []
    for part in range(parts):
        first, end = (len(messages) * k // parts for k in (part, part + 1))
        path = folder / f"{folder.name}_{part}.db3"
        write_file(path, messages[first:end], cdr[first:end], topics, compression == "MESSAGE")
        if compression == "FILE":
            packed_path = path.with_suffix(".db3.zstd")
            subprocess.run(["zstd", "-q", "--rm", "-f", str(path), "-o", str(packed_path)], check=True)
            path = packed_path
        files.append(path.name)
    write_metadata(folder, messages, topics, files, "sqlite3", compression)


def write_metadata(folder, messages, topics, files, storage, compression=""):
    times = [message[0] for message in messages]
    lines = ["rosbag2_bagfile_information:", "  version: 5", f"  storage_identifier: {storage}", "  duration:",
             f"    nanoseconds: {max(times) - min(times)}", "  starting_time:",
             f"    nanoseconds_since_epoch: {min(times)}", f"  message_count: {len(messages)}",
             "  topics_with_message_count:"]
    for name, kind in topics:
        count = sum(message[1] == name for message in messages)
        lines += ["    - topic_metadata:", f"        name: {name}", f"        type: {kind.replace('/', '/msg/')}",
                  "        serialization_format: cdr", "        offered_qos_profiles: \"\"",
                  f"      message_count: {count}"]
    lines += [f"  compression_format: \"{'zstd' if compression else ''}\"", f"  compression_mode: \"{compression}\"",
              "  relative_file_paths:"] + [f"    - {file}" for file in files]
    (folder / "metadata.yaml").write_text("\n".join(lines) + "\n")
