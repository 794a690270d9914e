"""Chromium without a window, as a desk, a tablet or a phone: its fingers and its mouse, its pictures and what it complained of."""

import json
import os
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

from mission_files import SOURCE_DIR

SHAPES = {"desk": (1280, 800, False), "tablet": (1024, 768, True), "phone": (390, 844, True)}
PICTURES = os.path.join(SOURCE_DIR, "build", "log", "web")
QUIET = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars")
FRAME_S = 0.02  # between two movements of a pointer, as devices send them


class Browser:
    def __init__(self, test, shape, language):
        width, height, self.touch = SHAPES[shape]
        profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        test.addCleanup(profile.cleanup)
        options = Options()
        options.binary_location = "/usr/bin/chromium"
        for option in (*QUIET, f"--lang={language}", f"--window-size={width},{height}", f"--user-data-dir={profile.name}"):
            options.add_argument(option)
        options.add_experimental_option("prefs", {"intl.accept_languages": language})
        options.add_experimental_option("perfLoggingPrefs", {"enableNetwork": True, "enablePage": False})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver", log_path=os.path.join(profile.name, "chromedriver.log")), options=options)
        test.addCleanup(self.driver.quit)
        self.driver.set_script_timeout(60)
        self.tell("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1.5 if self.touch else 1, mobile=self.touch)
        if self.touch:
            self.tell("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        self.shape = shape
        self.requests = []
        self.complaints = []

    def tell(self, command, **keys):
        return self.driver.execute_cdp_cmd(command, keys)

    def press(self, place):
        self._point("touchStart" if self.touch else "mousePressed", place)

    def move(self, place):
        self._point("touchMove" if self.touch else "mouseMoved", place)
        time.sleep(FRAME_S)

    def release(self, place):
        self._point("touchEnd" if self.touch else "mouseReleased", place)

    def _point(self, kind, place):
        if self.touch:
            self.tell("Input.dispatchTouchEvent", type=kind, touchPoints=[] if kind == "touchEnd" else [{"x": place[0], "y": place[1]}])
        else:
            self.tell("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", buttons=0 if kind == "mouseReleased" else 1, clickCount=1)

    def tap(self, place):
        self.press(place)
        self.release(place)

    def drag(self, start, end, on_the_way=lambda: None, steps=6):
        self.press(start)
        for i in range(1, steps + 1):
            self.move([a + (b - a) * i / steps for a, b in zip(start, end)])
        on_the_way()
        self.release(end)

    def picture(self, name):
        os.makedirs(PICTURES, exist_ok=True)
        self.driver.save_screenshot(os.path.join(PICTURES, f"{name}-{self.shape}.png"))

    def read_logs(self):
        """Adds to `requests`, addresses, and to `complaints`."""
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                self.requests.append(message["params"]["request"]["url"])
            elif message["method"] == "Network.webSocketCreated":
                self.requests.append(message["params"]["url"])
        self.complaints += [entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
