#!/usr/bin/env python3
"""A ROS client, npm's roslib, at the console's server: a whole search by topics and services, beside a real controller."""

import base64
import json
import os
import queue
import re
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "integration"))

import npm_packages
from mission_files import BUILD_DIR, IVO, MISSION, SOURCE_DIR, write_mission

CONSOLE = os.path.join(BUILD_DIR, "ivo-console")
CLIENT = os.path.join(HERE, "ros_client")
ROBOT = os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml")
PATIENCE_S = 30
# A map of ROS whose frame begins elsewhere: free, with an occupied corner and an unknown one.
SIDE_PX = 48
ORIGIN = (-3.0, 7.0)


def write_ros_map(folder):
    rows = [bytearray([254] * SIDE_PX) for _ in range(SIDE_PX)]
    for row in rows[:4]:
        row[:4] = bytes(4)
        row[-4:] = bytes([205] * 4)
    with open(os.path.join(folder, "map.pgm"), "wb") as file:
        file.write(b"P5\n%d %d\n255\n" % (SIDE_PX, SIDE_PX) + b"".join(rows))
    with open(os.path.join(folder, "map.yaml"), "w", encoding="utf-8") as file:
        file.write("image: map.pgm\nmode: trinary\nresolution: 0.25\norigin: [%g, %g, 0]\nnegate: 0\n" % ORIGIN +
                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n")


def write_robot(folder):
    """As it is shipped, but that it goes on for half a minute while a busy host gives the client no time. Its name, beside the mission."""
    with open(ROBOT, encoding="utf-8") as file:
        text = file.read()
    shipped = "\noperator_timeout_s = 2.0 "
    assert shipped in text, shipped
    with open(os.path.join(folder, "own_robot.toml"), "w", encoding="utf-8") as file:
        file.write(text.replace(shipped, "\noperator_timeout_s = 30.0 "))
    return "own_robot.toml"


class RosClient:
    """roslib in node; what it hears is kept by kind."""

    def __init__(self, url):
        packages = npm_packages.install(CLIENT)
        self.process = subprocess.Popen(["node", os.path.join(CLIENT, "client.js"), packages, url], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)
        self.heard = []
        self.lines = queue.Queue()
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.lines.put(json.loads(line))
        self.lines.put({"event": "end"})

    def close(self):
        self.process.stdin.close()
        self.reader.join(PATIENCE_S)
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def do(self, what, **fields):
        self.process.stdin.write(json.dumps({"do": what, **fields}) + "\n")
        self.process.stdin.flush()

    def wait(self, event, right=lambda said: True):
        """The first that is right, of what is heard from now on or was heard and not asked for."""
        until = time.monotonic() + PATIENCE_S
        waiting = self.heard
        self.heard = []
        while True:
            for i, said in enumerate(waiting):
                if said["event"] == event and right(said):
                    self.heard += waiting[i + 1:]
                    return said
                self.heard.append(said)
            waiting = [self.lines.get(timeout=max(0.1, until - time.monotonic()))]
            if waiting[0]["event"] == "end":
                raise EOFError("the client ended")

    def message(self, topic, right=lambda msg: True):
        return self.wait("message", lambda said: said["topic"] == topic and right(said["msg"]))["msg"]

    def subscribed(self, topic, type_name, right=lambda msg: True, **more):
        self.do("subscribe", topic=topic, type=type_name, **more)
        return self.message(topic, right)

    def call(self, service):
        self.tag = getattr(self, "tag", 0) + 1
        self.do("call", service=service, type="std_srvs/Trigger", tag=self.tag)
        return self.wait("response", lambda said: said["tag"] == self.tag)

    def refused(self):
        return self.wait("status", lambda said: said["status"]["level"] == "error")["status"]["msg"]


class Ros(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.socket = os.path.join(self.folder, "console")
        self.state = os.path.join(self.folder, "state")
        mission = MISSION.replace('"drawn"', '"unknown"').replace("map.toml", "map.yaml").replace(ROBOT, write_robot(self.folder))
        write_ros_map(self.folder)
        self.controller = self.start([IVO, "run", write_mission(self.folder, mission), "--console", self.socket, "--no-real-time",
                                      "--out", os.path.join(self.folder, "out")], stdout=subprocess.DEVNULL)
        page = os.path.join(self.folder, "page")  # the page is another test's
        os.makedirs(page)
        with open(os.path.join(page, "index.html"), "w", encoding="utf-8") as file:
            file.write("<!DOCTYPE html>")
        server = self.start([CONSOLE, "--socket", self.socket, "--port", "0", "--state", self.state, "--web", page], stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.stdout.close)
        place, line = None, "before its first line"
        while place is None and line:
            line = server.stdout.readline()
            place = re.search(r"listening at http://([^/]+)/", line)
        self.assertIsNotNone(place, "the server ended")
        self.place = place.group(1)
        reader = threading.Thread(target=server.stdout.read, daemon=True)
        reader.start()
        self.addCleanup(reader.join)
        self.addCleanup(server.terminate)

    def start(self, command, **options):
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, **options)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def client(self, role="operator"):
        done = subprocess.run([CONSOLE, "--state", self.state, "--new-token", role, "--role", role], capture_output=True, text=True, check=True)
        client = RosClient(f"ws://{self.place}/?token={done.stdout.split()[-1]}")
        self.addCleanup(client.close)
        client.wait("connection")
        return client

    def accepted(self, client, service):
        answer = client.call(service)
        self.assertTrue(answer["ok"] and answer["values"]["success"], f"{service}: {answer}")

    def start_search(self, client):
        """A client that a busy host gave no time for a second, to answer a ping, is not fresh: then it is asked anew."""
        until = time.monotonic() + PATIENCE_S
        answer = client.call("/ivo/start")
        while not answer["values"]["success"]:
            self.assertEqual(answer["values"]["message"], "not_fresh")
            self.assertLess(time.monotonic(), until, "it never counted")
            answer = client.call("/ivo/start")

    def plan_of(self, diagnostics):
        """Its number and its state."""
        planner = next(status for status in diagnostics["status"] if status["name"] == "ivo: planner")
        return int(next(value["value"] for value in planner["values"] if value["key"] == "plan")), planner["message"]

    def test_a_search_by_services_and_topics(self):
        client = self.client()
        client.subscribed("/ivo/state", "std_msgs/String", lambda msg: msg["data"] == "awaiting consent")
        path = client.subscribed("/ivo/plan/IVO", "nav_msgs/Path", lambda msg: msg["poses"])
        first = path["poses"][0]["pose"]["position"]
        self.assertEqual((first["x"], first["y"]), (1.5 + ORIGIN[0], 1.5 + ORIGIN[1]))

        answer = client.call("/ivo/start")
        self.assertFalse(answer["values"]["success"])
        self.assertIn("/ivo/accept", answer["values"]["message"])
        self.assertEqual(client.call("/ivo/accept")["values"]["message"], "not_allowed")
        self.accepted(client, "/ivo/take_control")

        corners = [(x + ORIGIN[0], y + ORIGIN[1]) for x, y in ((6, 6), (11, 6), (11, 11), (6, 11))]
        polygon = {"header": {"frame_id": "map"}, "polygon": {"points": [{"x": x, "y": y, "z": 0} for x, y in corners]}}
        client.do("publish", topic="/ivo/preferred_area/Ana", type="geometry_msgs/PolygonStamped", msg=polygon)
        markers = client.subscribed("/ivo/areas", "visualization_msgs/MarkerArray", lambda msg: len(msg["markers"]) == 2)["markers"]
        self.assertEqual([(p["x"], p["y"]) for p in markers[1]["points"]][:4], corners)
        number, _ = self.plan_of(client.subscribed("/diagnostics", "diagnostic_msgs/DiagnosticArray"))
        self.accepted(client, "/ivo/replan")
        client.message("/diagnostics", lambda msg: self.plan_of(msg) == (number + 1, "a plan is ready") and
                       msg["status"][0]["message"] == "awaiting consent")
        self.accepted(client, "/ivo/accept")
        self.start_search(client)
        client.message("/ivo/state", lambda msg: msg["data"] == "searching")
        start = client.subscribed("/ivo/pose/IVO", "geometry_msgs/PoseStamped")["pose"]["position"]
        client.message("/ivo/pose/IVO", lambda msg: msg["pose"]["position"] != start)
        client.do("publish", topic="/ivo/button/object_found", type="std_msgs/Empty", msg={})
        client.message("/ivo/state", lambda msg: msg["data"] == "done")

    def test_grids_come_as_typed_arrays_in_cbor_and_as_lists_in_json(self):
        client = self.client("viewer")
        grid = client.subscribed("/ivo/map", "nav_msgs/OccupancyGrid", compression="cbor")
        self.assertEqual(grid["data"]["typed"], "Int8Array")
        values = grid["data"]["values"]
        self.assertEqual((grid["info"]["width"], grid["info"]["height"], len(values)), (SIDE_PX, SIDE_PX, SIDE_PX * SIDE_PX))
        self.assertEqual((grid["info"]["origin"]["position"]["x"], grid["info"]["origin"]["position"]["y"]), ORIGIN)
        self.assertEqual(values.count(100), 32)
        self.assertEqual(values[-SIDE_PX], 100)
        probability = client.subscribed("/ivo/probability", "nav_msgs/msg/OccupancyGrid")
        self.assertIn("nanosec", probability["header"]["stamp"])
        self.assertLess(abs(probability["header"]["stamp"]["sec"] - time.time()), 60)
        self.assertEqual(max(probability["data"]), 100)
        mass = client.subscribed("/ivo/belief/mass", "std_msgs/Float32MultiArray", compression="cbor")
        self.assertEqual(mass["data"]["typed"], "Float32Array")
        self.assertAlmostEqual(sum(mass["data"]["values"]), 1.0, 4)
        diagnostics = client.subscribed("/diagnostics", "diagnostic_msgs/DiagnosticArray", compression="cbor")
        self.assertEqual(diagnostics["status"][0]["name"], "ivo: controller")
        for topic, type_name in (("/ivo/no_go", "nav_msgs/OccupancyGrid"), ("/tf", "tf2_msgs/TFMessage"), ("/ivo/plan", "nav_msgs/Path")):
            client.subscribed(topic, type_name)

    def test_rosapi_names_what_there_is(self):
        client = self.client("viewer")
        client.subscribed("/ivo/map", "nav_msgs/OccupancyGrid")  # then the mission is known
        client.do("topics")
        topics = client.wait("topics")
        named = dict(zip(topics["topics"], topics["types"]))
        self.assertEqual(named["/ivo/person/Ana/pose"], "geometry_msgs/PoseStamped")
        client.do("services")
        self.assertIn("/ivo/start", client.wait("services")["services"])
        client.do("type_of", topic="/ivo/plan/IVO")
        self.assertEqual(client.wait("type_of")["type"], "nav_msgs/Path")

    def test_what_a_robot_sees_is_taken_and_what_is_wrong_is_named(self):
        client = self.client("viewer")
        client.subscribed("/ivo/map", "nav_msgs/OccupancyGrid")
        scan = {"header": {"frame_id": "laser"}, "angle_min": 0, "angle_max": 3, "angle_increment": 0.01, "range_min": 0.1,
                "range_max": 10, "ranges": [2.0] * 300, "intensities": []}
        client.do("publish", topic="/scan", type="sensor_msgs/LaserScan", msg=scan)
        cloud = {"header": {"frame_id": "base_link"}, "height": 1, "width": 20000, "point_step": 12, "row_step": 240000, "is_bigendian": False,
                 "is_dense": True, "fields": [{"name": name, "offset": 4 * i, "datatype": 7, "count": 1} for i, name in enumerate("xyz")],
                 "data": base64.b64encode(struct.pack("<fff", 1, 2, 3) * 20000).decode()}
        client.do("publish", topic="/points", type="sensor_msgs/PointCloud2", msg=cloud)
        client.do("publish", topic="/scan", type="sensor_msgs/LaserScan", msg={**scan, "header": {"frame_id": "camera"}})
        self.assertIn('/scan: msg: header.frame_id: "camera" is another frame; expected one of base_link', client.refused())
        client.do("send", text="no JSON")
        self.assertIn("not JSON", client.refused())
        client.do("send", text='{"op":"fragment","id":"f","data":"x","num":0,"total":1}')
        self.assertIn("fragment: parts are not put together here", client.refused())
        client.do("publish", topic="/ivo/button/init", type="std_msgs/Empty", msg={})
        self.assertEqual(client.refused(), "/ivo/button/init: not_allowed")


if __name__ == "__main__":
    unittest.main()
