"""Controls a headless Chromium with the DevTools protocol over two pipes. It needs only the Python standard library.

  with Browser() as browser, browser.open(path, 1400, 900, dark=False) as page:
      page.value("document.title")
"""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

PROGRAMS = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"]


def program():
    """Returns the first installed browser, or None."""
    return next(filter(None, map(shutil.which, PROGRAMS)), None)


class Failed(Exception):
    """Raised if the browser rejects a command, or if a script in the page throws an exception."""


class Browser:
    def __init__(self, seconds=60):
        self.seconds = seconds
        self.folder = tempfile.TemporaryDirectory(prefix="triptych-browser-", ignore_cleanup_errors=True)
        self.events = []
        self.number = 0
        self.rest = b""
        to_browser, self.commands = os.pipe()
        self.answers, from_browser = os.pipe()
        # The DevTools protocol uses the file descriptors 3 and 4. Chromium's sandbox is disabled, because it needs
        # privileges that a container lacks. This is safe, because the tests create all pages themselves.
        launch = f'exec 3<&{to_browser} 4>&{from_browser}; exec "$@"'
        self.process = subprocess.Popen(
            ["bash", "-c", launch, "browser", program(), "--headless", "--no-sandbox", "--remote-debugging-pipe",
             "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
             f"--user-data-dir={self.folder.name}", "about:blank"],
            pass_fds=(to_browser, from_browser), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.commands)
        os.close(self.answers)
        self.process.terminate()
        self.process.wait()
        self.folder.cleanup()

    def message(self):
        while b"\0" not in self.rest:
            some = os.read(self.answers, 1 << 20)
            if not some:
                raise Failed("the browser has ended")
            self.rest += some
        first, _, self.rest = self.rest.partition(b"\0")
        return json.loads(first)

    def call(self, method, session=None, **parameters):
        self.number += 1
        command = {"id": self.number, "method": method, "params": parameters}
        if session:
            command["sessionId"] = session
        os.write(self.commands, json.dumps(command).encode() + b"\0")
        while True:
            answer = self.message()
            if answer.get("id") != self.number:
                self.events.append(answer)
            elif "error" in answer:
                raise Failed(f"{method}: {answer['error']}")
            else:
                return answer["result"]

    def open(self, path, width, height, dark):
        return Page(self, path, width, height, dark)


class Page:
    """Opens a file in a new tab. `complaints` collects the errors and warnings from the console."""

    def __init__(self, browser, path, width, height, dark):
        self.browser = browser
        self.target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Accessibility", "DOM"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                  mobile=False)
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.call("Page.navigate", url=f"file://{os.path.abspath(path)}")
        self.until("document.readyState === 'complete'")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.browser.call("Target.closeTarget", targetId=self.target)

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def value(self, expression):
        """Returns the value of a JavaScript expression as a Python object."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise Failed(details.get("exception", details).get("description", details["text"]))
        return result["result"].get("value")

    def until(self, expression):
        end = time.monotonic() + self.browser.seconds
        while not self.value(expression):
            if time.monotonic() > end:
                raise Failed(f"did not become true: {expression}")
            time.sleep(0.02)

    def press(self, key, shift=False):
        codes = {"Tab": 9, "Enter": 13, "Escape": 27, "ArrowLeft": 37, "ArrowRight": 39, "ArrowDown": 40, " ": 32,
                 "Home": 36, "End": 35}
        text = {"Enter": "\r", " ": " "}.get(key, "")
        common = {"key": key, "code": "Space" if key == " " else key, "windowsVirtualKeyCode": codes[key],
                  "modifiers": 8 if shift else 0}
        self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **common)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def screenshot(self, clip=None, whole=False):
        more = {"captureBeyondViewport": True} if whole else {}
        if clip:
            more["clip"] = dict(clip, scale=1)
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", **more)["data"])

    def names(self):
        """Returns (role, name) of everything that a screen reader reads, in reading order. White space around names is
        removed, because browsers differ in it."""
        nodes = self.call("Accessibility.getFullAXTree")["nodes"]
        return [(node["role"]["value"], node.get("name", {}).get("value", "").strip())
                for node in nodes if not node.get("ignored") and "role" in node]

    def complaints(self):
        self.value("0")
        said = []
        for event in self.browser.events:
            if event.get("sessionId") != self.session:
                continue
            details = event.get("params", {})
            if event["method"] == "Runtime.exceptionThrown":
                said.append(details["exceptionDetails"].get("exception", {}).get("description", "an exception"))
            elif event["method"] == "Runtime.consoleAPICalled" and details["type"] in ("error", "warning", "assert"):
                said.append(f"console.{details['type']}: {details['args']}")
            elif event["method"] == "Log.entryAdded" and details["entry"]["level"] in ("error", "warning"):
                said.append(f"{details['entry']['source']}: {details['entry']['text']}")
        return said
