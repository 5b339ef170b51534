"""A headless Chromium driven through chromedriver's WebDriver protocol (W3C), with the standard library alone."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
KEYS = {
    "Tab": "\ue004", "Enter": "\ue007", "Escape": "\ue00c", "Space": "\ue00d", "PageUp": "\ue00e", "PageDown": "\ue00f",
    "End": "\ue010", "Home": "\ue011", "Left": "\ue012", "Up": "\ue013", "Right": "\ue014", "Down": "\ue015",
    "Shift": "\ue008",
}
ARGUMENTS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--disable-dev-shm-usage", "--disable-extensions", "--hide-scrollbars"]


class Browser:
    """One window. Use as a context manager: leaving it ends the browser and removes its profile."""

    def __init__(self, width=1280, height=900):
        self.program = shutil.which("chromium")
        driver = shutil.which("chromedriver")
        if not self.program or not driver:
            raise RuntimeError("chromium and chromedriver are needed: packages.txt names them")
        self.profile = tempfile.mkdtemp(prefix="lightloom-browser-")
        self.driver = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                       env={**os.environ, "HOME": self.profile})
        self.base = f"http://127.0.0.1:{self._port()}"
        options = {"binary": self.program, "args": [*ARGUMENTS, f"--user-data-dir={self.profile}/profile",
                                                    f"--window-size={width},{height}"]}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options,
                  "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        session = self._request("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        self.base += f"/session/{session['sessionId']}"

    def _port(self):
        for line in self.driver.stdout:
            if "started successfully on port" in line:
                return int(line.rstrip(". \n").rsplit(" ", 1)[1])
        raise RuntimeError("chromedriver ended before it was ready")

    def _request(self, method, path, body=None):
        data = json.dumps(body).encode() if body is not None else None
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{method} {path}: {json.load(error)['value']['message']}") from None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._request("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait(timeout=20)
            self.driver.stdout.close()
            shutil.rmtree(self.profile, ignore_errors=True)

    def open(self, path):
        """A local file; returns once the page's script has run."""
        self._request("POST", "/url", {"url": "file://" + os.path.abspath(path)})
        self.wait("document.documentElement.dataset.ready === 'true'")

    def run(self, script, *arguments):
        """Value of a function body; `arguments[0]` and so on are the arguments."""
        return self._request("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def value(self, expression):
        return self.run("return " + expression)

    def wait(self, expression, seconds=10):
        end = time.monotonic() + seconds
        while not self.value(expression):
            if time.monotonic() > end:
                raise AssertionError(f"still not true after {seconds} s: {expression}")
            time.sleep(0.02)

    def find(self, selector):
        return self._request("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self.run("document.querySelector(arguments[0]).scrollIntoView({block: 'center', behavior: 'instant'})", selector)
        self._request("POST", f"/element/{self.find(selector)}/click", {})

    def focus(self, selector):
        self.run("document.querySelector(arguments[0]).focus()", selector)

    def press(self, *keys, shift=False):
        """Keys to whatever has the focus."""
        actions = []
        if shift:
            actions.append({"type": "keyDown", "value": KEYS["Shift"]})
        for key in keys:
            actions += [{"type": "keyDown", "value": KEYS.get(key, key)}, {"type": "keyUp", "value": KEYS.get(key, key)}]
        if shift:
            actions.append({"type": "keyUp", "value": KEYS["Shift"]})
        self._request("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def centre(self, selector):
        self.run("document.querySelector(arguments[0]).scrollIntoView({block: 'center', behavior: 'instant'})", selector)
        # The page hears of the scrolling in the next frame, which may come late, and hides what hovering has shown.
        self.run("return new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")
        box = self.run("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
                       "return [b.left + b.width / 2, b.top + b.height / 2]", selector)
        return round(box[0]), round(box[1])

    def drag(self, start, end):
        def move(point, duration):
            return {"type": "pointerMove", "x": point[0], "y": point[1], "duration": duration, "origin": "viewport"}
        actions = [move(start, 0), {"type": "pointerDown", "button": 0}, move(end, 60), {"type": "pointerUp", "button": 0}]
        pointer = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}
        self._request("POST", "/actions", {"actions": [pointer]})

    def hover(self, selector):
        x, y = self.centre(selector)
        action = {"type": "pointerMove", "x": x, "y": y, "duration": 0, "origin": "viewport"}
        self._request("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [action]}]})

    def wheel(self, selector, delta):
        x, y = self.centre(selector)
        scroll = {"type": "scroll", "x": x, "y": y, "deltaX": 0, "deltaY": delta, "duration": 0, "origin": "viewport"}
        self._request("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [scroll]}]})

    def devtools(self, command, **params):
        return self._request("POST", "/goog/cdp/execute", {"cmd": command, "params": params})

    def resize(self, width, height):
        """Of the page, whatever the smallest window is."""
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def media(self, **features):
        """Emulates media features: prefers_color_scheme='dark'."""
        listed = [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]
        self.devtools("Emulation.setEmulatedMedia", features=listed)

    def log(self, kind="browser"):
        """Entries since the last call: 'browser' is the console, 'performance' what the network was asked."""
        return self._request("POST", "/se/log", {"type": kind})

    def screenshot(self, file):
        with open(file, "wb") as out:
            out.write(base64.b64decode(self._request("GET", "/screenshot")))
