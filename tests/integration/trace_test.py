#!/usr/bin/env python3
"""`ivo run --trace` and `--log`: what readers that are not ours find in them, protoc and npm's @mcap/core."""

import base64
import json
import math
import os
import re
import resource
import signal
import struct
import subprocess
import tempfile
import time
import unittest

import npm_packages
from mission_files import IVO, MISSION, events, ivo, read_json, write_mission
from perfetto_reader import Trace

HERE = os.path.dirname(os.path.abspath(__file__))
READER = os.path.join(HERE, "mcap_reader")
PHASES = ["judge time", "take commands", "drain bus", "look at drives", "look for object", "decide mode", "choose velocity", "write", "think",
          "publish"]
STEPS = {"ants", "tour scores", "trails", "drafts", "route changes", "plan scores"}
LONG_PLAN = MISSION.replace("generations = 5", "generations = 30")  # improved, too
DRIVE_FAULT = '[[at]]\nt_s = 8.0\ndrive = "rear_left"\nfault = "reboot"\n'


def bytes_of(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def mass_of(grid):
    data = base64.b64decode(grid["data"])
    assert len(data) % grid["row_stride"] == 0
    return sum(struct.unpack(f"<{len(data) // 4}f", data))


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.trace = os.path.join(self.folder, "run.perfetto")
        self.log = os.path.join(self.folder, "run.mcap")

    def run_mission(self, *args, out="out", mission=MISSION):
        return ivo("run", write_mission(self.folder, mission), "--speed", "max", "--out", os.path.join(self.folder, out), *args)

    def read_mcap(self):
        packages = npm_packages.install(READER)
        return json.loads(npm_packages.run("node", os.path.join(READER, "read_mcap.js"), packages, self.log))


class Perfetto(Scratch):
    """A run to which nobody consents: planning, start-up of the drives, no motion."""

    def test_protoc_reads_cycles_with_ten_phases_each_and_slices_of_the_planner(self):
        done = self.run_mission("--trace", self.trace, mission=LONG_PLAN)
        self.assertEqual(done.returncode, 3, done.stderr)
        trace = Trace(self.trace)
        self.assertIn(f" events in {self.trace}\n", done.stdout)

        slices = trace.slices("cycle")
        cycles = [part for part in slices if part[0] == 0]
        phases = [part for part in slices if part[0] == 1]
        self.assertEqual({name for _, name, _, _ in cycles}, {"cycle"})
        self.assertEqual([name for _, name, _, _ in phases], PHASES * len(cycles))
        for i, (_, _, begin, end) in enumerate(cycles):
            own = phases[i * len(PHASES):(i + 1) * len(PHASES)]
            self.assertEqual(own[0][2], begin)
            self.assertLessEqual(own[-1][3], end)
            for before, after in zip(own, own[1:]):
                self.assertEqual(before[3], after[2], "a phase begins where the one before it ended")

        steps = trace.slices("planner")
        self.assertLessEqual({name for _, name, _, _ in steps}, STEPS)
        self.assertIn("route changes", {name for _, name, _, _ in steps})
        thinking = [part for part in phases if part[1] == "think"]
        for _, _, begin, end in steps:
            self.assertTrue(any(phase[2] <= begin and end <= phase[3] for phase in thinking), "slices lie within a think phase")

        units = sum(event["notes"]["units"] for event in trace.events["planner"] if event["type"] == "TYPE_SLICE_BEGIN")
        counted = sum(event["value"] for event in trace.events["planner units in a cycle"])
        self.assertGreater(units, 0)
        self.assertEqual(units, counted)
        moves = sum(event["notes"]["moves"] for event in trace.events["planner"] if event["type"] == "TYPE_SLICE_BEGIN")
        self.assertGreater(moves, 1000, "changes of a route")
        self.assertEqual(len(trace.events["cycle took"]), len(cycles))
        self.assertEqual(len(trace.events["wake-up latency"]), len(cycles))
        self.assertEqual([event["value"] for event in trace.events["trace events lost"]], [0])

        modes = [name for _, name, _, _ in trace.slices("mode")]
        told = [event["mode"] for event in events(os.path.join(self.folder, "out")) if event["event"] == "mode"]
        self.assertEqual(modes, ["planning"] + told)

        sent, received = map(int, re.search(r"(\d+) frames sent, (\d+) received", done.stdout).groups())
        self.assertEqual(len(trace.events["frames in"]), received)
        self.assertEqual(len(trace.events["frames out"]), sent)
        boot = next(event for event in trace.events["frames in"] if event["notes"]["COB-ID"] == "701")
        self.assertEqual(boot["notes"]["data"], "00", "a boot-up message")

    def test_a_fault_is_an_instant_with_its_words(self):
        script = os.path.join(self.folder, "script.toml")
        with open(script, "w", encoding="utf-8") as file:
            file.write(DRIVE_FAULT)
        done = self.run_mission("--yes", "--script", script, "--trace", self.trace, "--log", self.log)
        self.assertEqual(done.returncode, 1, done.stdout)
        faults = [event["name"] for event in Trace(self.trace).events["faults, overruns, bus"]]
        reason = read_json(self.folder, "out", "report.json")["drive_fault"]
        self.assertEqual(faults, [f"fault: {reason}"])
        told = [message for message in self.read_mcap()["topics"]["/events"]["messages"] if message["level"] == 4]
        self.assertEqual([message["message"] for message in told], [f"fault: {reason}"])


class Mcap(Scratch):
    def test_a_reader_that_is_not_ours_finds_the_whole_search(self):
        done = self.run_mission("--yes", "--log", self.log)
        self.assertEqual(done.returncode, 0, done.stderr)
        read = self.read_mcap()
        topics = read["topics"]
        self.assertTrue(read["whole"])
        self.assertEqual(sorted(topics), ["/Ana/pose", "/IVO/pose", "/belief", "/command", "/events", "/plan/Ana", "/plan/IVO", "/tf", "/timing",
                                          "/wheels"])
        count = sum(len(topic["messages"]) for topic in topics.values())
        self.assertEqual(int(read["summary"]["statistics"]["messageCount"]), count)
        self.assertEqual(sorted(read["summary"]["topics"]), sorted(topics))
        self.assertEqual(read["summary"]["read"], count, "by the index, chunk by chunk")
        self.assertGreater(read["summary"]["chunks"], 10)
        self.assertEqual(read["summary"]["chunks"], int(read["summary"]["statistics"]["chunkCount"]))
        self.assertIn(f" {count} messages in {self.log}\n", done.stdout)
        for name, topic in topics.items():
            self.assertEqual((topic["encoding"], topic["messageEncoding"]), ("jsonschema", "json"), name)
            for message in topic["messages"][:1]:
                self.assertLessEqual(set(message), set(topic["schema"]["properties"]), name)
            self.assertEqual(topic["times"], sorted(topic["times"]), name)

        plan = read_json(self.folder, "out", "plan.json")
        for agent in plan["agents"]:
            planned = topics[f"/plan/{agent['name']}"]["messages"][0]["poses"]
            self.assertEqual([[pose["position"]["x"], pose["position"]["y"]] for pose in planned],
                             [[float(f"{x:.9g}") for x in place] for place in agent["waypoints_m"]])
        poses = {name: {at: message["pose"]["position"] for at, message in zip(topic["times"], topic["messages"])}
                 for name, topic in topics.items() if name.endswith("/pose")}
        for event in events(os.path.join(self.folder, "out")):
            if event["event"] == "position":
                own = poses[f"/{event['agent']}/pose"]
                near = own[min(own, key=lambda at, t_s=event["t_s"]: abs(at - t_s * 1e9))]
                self.assertAlmostEqual(near["x"], event["x_m"], delta=0.02)
                self.assertAlmostEqual(near["y"], event["y_m"], delta=0.02)
        self.assertGreater(max(math.hypot(message["vx_mps"], message["vy_mps"]) for message in topics["/command"]["messages"]), 0.3)

        left = [mass_of(grid) for grid in topics["/belief"]["messages"]]
        self.assertAlmostEqual(left[0], 1.0, delta=1e-4)
        self.assertEqual(left, sorted(left, reverse=True), "what was looked at stays looked at")
        self.assertLess(left[-1], 0.9)
        timing = topics["/timing"]["messages"]
        self.assertEqual(set(timing[0]["phases_us"]), set(PHASES))
        self.assertEqual(len(set(topics["/timing"]["times"])), len(timing), "one a cycle")


class Run(Scratch):
    def test_a_run_is_the_same_with_and_without(self):
        for args, out in (((), "plain"), (("--trace", self.trace, "--log", self.log), "traced")):
            done = self.run_mission("--yes", *args, out=out)
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("plan.json", "report.json", "events.jsonl"):
            self.assertEqual(bytes_of(self.folder, "plain", name), bytes_of(self.folder, "traced", name), name)

    def test_a_file_that_is_something_else_is_left_alone(self):
        mission = write_mission(self.folder)
        for option, words in (("--trace", "no trace of events"), ("--log", "no log of messages")):
            done = self.run_mission("--yes", option, mission)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, rf"^ivo: .*mission\.toml: is there already and is {words}; expected .*\n$")
        self.assertEqual(self.run_mission("--trace", self.trace).returncode, 3)
        self.assertEqual(self.run_mission("--trace", self.trace).returncode, 3, "its own is replaced")
        earlier = bytes_of(self.trace)
        record = os.path.join(self.folder, "bus.log")
        with open(record, "w", encoding="utf-8") as file:
            file.write("(0.000000) vcan0 080#\n")
        for speed in ("max", "1"):  # with writers of their own, and without
            done = ivo("run", mission, "--speed", speed, "--record", record, "--trace", self.trace, "--log", mission)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(bytes_of(self.trace), earlier, "a run that is refused replaces nothing")
            self.assertEqual(bytes_of(record), b"(0.000000) vcan0 080#\n")
        self.assertGreater(len(earlier), 1000)

    def test_without_the_kernels_trace_lines_in_it_are_refused_before_anything_starts(self):
        marker = "/sys/kernel/tracing/trace_marker"
        done = self.run_mission("--trace-marker")
        if os.access(marker, os.W_OK):
            self.assertEqual(done.returncode, 3, done.stderr)
        else:
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, rf"^ivo: {marker}: cannot be written: .*; expected tracefs to be mounted there, and root\n$")

    def test_a_disk_that_is_full_is_told_in_one_line_and_the_search_goes_on(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1_000_000, 1_000_000))

        done = subprocess.run([IVO, "run", write_mission(self.folder), "--yes", "--speed", "max", "--out", os.path.join(self.folder, "out"),
                               "--trace", self.trace], capture_output=True, text=True, stdin=subprocess.DEVNULL, preexec_fn=limit, check=False)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"^ivo: .*run\.perfetto: the trace ends early, \d+ events are missing: File too large\n$")
        self.assertIn(read_json(self.folder, "out", "report.json")["end"], ("found", "paths_ended"))
        self.assertLessEqual(os.path.getsize(self.trace), 1_000_000)
        self.assertGreater(len(Trace(self.trace).packets), 1000, "protoc reads it to its end")

    def test_a_program_that_is_killed_leaves_files_that_open_and_who_goes_on_leaves_them_alone(self):
        mission = MISSION.replace('object = "drawn"', 'object = "unknown"')
        record = os.path.join(self.folder, "bus")
        files = ("--trace", self.trace, "--log", self.log, "--record", record)
        process = subprocess.Popen(
            [IVO, "run", write_mission(self.folder, mission), "--yes", "--speed", "1", "--out", os.path.join(self.folder, "out"), *files], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        for line in process.stdout:
            if line.startswith("searching"):
                break
        for _ in range(2):  # chunks: a second each
            size = os.path.getsize(self.log)
            while os.path.getsize(self.log) == size and process.poll() is None:
                time.sleep(0.1)
        process.kill()
        process.communicate()
        trace = Trace(self.trace)
        self.assertIn("searching", [event["name"] for event in trace.events["mode"]])
        read = self.read_mcap()
        self.assertFalse(read["whole"], "there is no summary")
        self.assertGreater(len(read["topics"]["/timing"]["messages"]), 20)
        self.assertEqual(len(read["topics"]["/plan/IVO"]["messages"]), 1)

        left = [bytes_of(path) for path in (self.trace, self.log, record)]
        done = self.run_mission("--resume", *files, mission=mission)
        self.assertEqual(done.returncode, 3, done.stderr)
        previous = [os.path.join(self.folder, name) for name in ("run.previous.perfetto", "run.previous.mcap", "bus.previous")]
        self.assertEqual([bytes_of(path) for path in previous], left)
        for path, aside in zip((self.trace, self.log, record), previous):
            self.assertIn(f" in {path}, the one before in {aside}\n", done.stdout)
        belief = [[mass_of(grid) for grid in topics["/belief"]["messages"]] for topics in (read["topics"], self.read_mcap()["topics"])]
        self.assertAlmostEqual(belief[0][0], 1.0, delta=1e-4)
        self.assertLess(belief[1][0], 0.95, "what was looked at before stays looked at")
        self.assertAlmostEqual(belief[1][0], belief[0][-1], delta=0.1)


class Profile(Scratch):
    def test_says_where_the_time_went_and_writes_nothing(self):
        mission = write_mission(self.folder, LONG_PLAN)
        before = sorted(os.listdir(self.folder))
        done = ivo("profile", mission)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        for phase in PHASES:
            self.assertEqual(len(re.findall(rf"^  {phase} +(?: +[\d.]+){{4}} +[\d.]+ %$", done.stdout, re.M)), 2, phase)
        self.assertRegex(done.stdout, r"(?m)^  route changes( +[\d.]+){4} +[\d.]+ % +[\d,]+ +[\d.]+ +[\d,]+$")
        self.assertRegex(done.stdout, r"[\d,]+ moves a second at the median cost of a unit")
        self.assertRegex(done.stdout, r"events, none lost")
        self.assertRegex(done.stdout, r"(?m)^time +simulated: 100,000 units of planner work a cycle; ")

    def test_beside_a_clock_that_does_not_wait_every_cycle_is_in_the_figures(self):
        log = os.path.join(self.folder, "run.mcap")
        done = ivo("profile", write_mission(self.folder), "--speed", "5", "--log", log)
        self.assertEqual(done.returncode, 0, done.stderr)
        measured = int(re.search(r"([\d,]+) cycles of", done.stdout)[1].replace(",", ""))
        told = sum(int(cycles.replace(",", "")) for cycles in re.findall(r"(?m)^(?:while|without) planning, ([\d,]+) cycles", done.stdout))
        self.assertEqual(measured, told)
        self.log = log
        self.assertEqual(measured, len(self.read_mcap()["topics"]["/timing"]["messages"]))

    def test_ends_with_the_plan_where_that_is_asked_for(self):
        done = ivo("profile", write_mission(self.folder), "--planning-only")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("search started", done.stdout)


if __name__ == "__main__":
    unittest.main()
