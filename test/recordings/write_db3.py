#!/usr/bin/env python3
"""Writes sqlite3 bags as rosbag2 lays them out: messages as JSON on standard input; the folder, and for one small file the
size of its pages, as arguments."""
import base64
import json
import os
import sqlite3
import sys

folder = sys.argv[1]
page_size = int(sys.argv[2]) if len(sys.argv) > 2 else 4096
messages = json.load(sys.stdin)


def write(path, part):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    database = sqlite3.connect(path)
    database.execute(f"PRAGMA page_size = {page_size}")
    database.executescript("""
        CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
        CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
          serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
          data BLOB NOT NULL);
        CREATE INDEX timestamp_idx ON messages (timestamp ASC);
        INSERT INTO schema VALUES (3, 'humble');
    """)
    topics = {}
    for message in messages:  # every file of a bag names all topics
        if message["topic"] not in topics:
            topics[message["topic"]] = len(topics) + 1
            database.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')",
                             (topics[message["topic"]], message["topic"], message["type"]))
    for message in part:
        database.execute("INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)",
                         (topics[message["topic"]], int(message["time"]), base64.b64decode(message["data"])))
    database.commit()
    database.execute("VACUUM")
    database.close()


if len(sys.argv) > 2:
    write(os.path.join(folder, "small.db3"), messages)
    sys.exit()
half = len(messages) // 2
write(os.path.join(folder, "two_files", "two_files_0.db3"), messages[:half])
write(os.path.join(folder, "two_files", "two_files_1.db3"), messages[half:])
with open(os.path.join(folder, "two_files", "metadata.yaml"), "w") as file:
    file.write("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
               "  relative_file_paths:\n    - two_files_0.db3\n    - two_files_1.db3\n"
               "  compression_format: \"\"\n  compression_mode: \"\"\n")
