"""Traces as Google's protoc reads them, by the messages of perfetto.proto."""

import os
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))


def messages(lines):
    """protoc's text as nested dicts; a field is a list of its values, in order."""
    message = {}
    for line in lines:
        line = line.strip()
        if line == "}":
            break
        if line.endswith("{"):
            message.setdefault(line[:-1].strip(), []).append(messages(lines))
        else:
            name, value = line.split(": ", 1)
            message.setdefault(name, []).append(value.strip('"') if value.startswith('"') else int(value) if value.lstrip("-").isdigit() else value)
    return message


def packets(path):
    with open(path, "rb") as file:
        done = subprocess.run(["protoc", f"--proto_path={HERE}", "--decode=Trace", "perfetto.proto"], stdin=file, capture_output=True,
                              text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return messages(iter(done.stdout.splitlines())).get("packet", [])


class Trace:
    """Tracks by name; of each its events in the order of the file: type, time, name, notes and value."""

    def __init__(self, path):
        self.packets = packets(path)
        self.tracks = {}  # name -> descriptor
        self.events = {}  # name -> events
        names, notes, by_uuid = {}, {}, {}
        for packet in self.packets:
            for data in packet.get("interned_data", []):
                names.update((entry["iid"][0], entry["name"][0]) for entry in data.get("event_names", []))
                notes.update((entry["iid"][0], entry["name"][0]) for entry in data.get("debug_annotation_names", []))
            for track in packet.get("track_descriptor", []):
                name = track.get("name", ["process"])[0]
                by_uuid[track["uuid"][0]] = name
                self.tracks[name] = track
                self.events[name] = []
            for event in packet.get("track_event", []):
                self.events[by_uuid[event["track_uuid"][0]]].append({
                    "type": event["type"][0],
                    "at": packet["timestamp"][0],
                    "name": names[event["name_iid"][0]] if "name_iid" in event else None,
                    "notes": {notes[note["name_iid"][0]]: note.get("int_value", note.get("string_value"))[0]
                              for note in event.get("debug_annotations", [])},
                    "value": event.get("counter_value", [None])[0],
                })

    def slices(self, track):
        """(depth, name, begin, end) in the order in which they ended; raises where they do not nest."""
        open_slices, closed = [], []
        for event in sorted(self.events[track], key=lambda event: event["at"]):
            if event["type"] == "TYPE_SLICE_BEGIN":
                open_slices.append(event)
            elif event["type"] == "TYPE_SLICE_END":
                begin = open_slices.pop()
                closed.append((len(open_slices), begin["name"], begin["at"], event["at"]))
        if open_slices:
            raise ValueError(f"{track}: {open_slices[-1]} has no end")
        return closed
