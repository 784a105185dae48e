"""Chromium without a window, driven through its debugging pipe. Python 3 alone."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

# WebGL in software: pictures are the same on machines with and without a graphics card.
ARGUMENTS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
             "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-color-profile=srgb",
             "--remote-debugging-pipe"]


def program():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if shutil.which(name):
            return shutil.which(name)
    raise SystemExit("expected chromium in the path")

# Of a report: presses the button that says so; where its 3D view is, in pixels.
PRESS = "[...document.querySelectorAll('button')].find(b => b.textContent.trim() === '%s').click()"
VIEW = """(() => {
  const { left, top, right, bottom } = document.getElementById('view').getBoundingClientRect();
  return [left, top, right, bottom].map(Math.round);
})()"""


class Page:
    """One page of a browser that lives as long as the `with` block."""

    def __init__(self, width, height):
        self.size = (width, height)

    def __enter__(self):
        self.profile = tempfile.mkdtemp()
        to_read, self.to_write = os.pipe()
        self.from_read, from_write = os.pipe()
        # The browser reads commands at 3 and writes answers at 4.
        def wire():
            saved = (os.dup(to_read), os.dup(from_write))
            os.dup2(saved[0], 3)
            os.dup2(saved[1], 4)
        self.browser = subprocess.Popen([program(), f"--user-data-dir={self.profile}", *ARGUMENTS], preexec_fn=wire,
                                        close_fds=False, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(from_write)
        self.count, self.buffer, self.session = 0, b"", None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Page.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=self.size[0], height=self.size[1], deviceScaleFactor=1,
                  mobile=False)
        return self

    def __exit__(self, *_):
        self.browser.terminate()
        self.browser.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, method, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to_write, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.buffer:
                chunk = os.read(self.from_read, 1 << 16)
                if not chunk:
                    raise SystemExit("the browser ended")
                self.buffer += chunk
            text, self.buffer = self.buffer.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise SystemExit(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def open(self, path):
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        for _ in range(600):
            if self.run("document.readyState") == "complete" and self.run("typeof foretouch") == "object":
                break
            time.sleep(0.1)
        self.run("foretouch.ready.then(() => 0)")

    def run(self, script):
        result = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise SystemExit(f"{script}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def shoot(self, path):
        # Two frames: what was asked for is drawn in the first.
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))")
        time.sleep(0.7)  # panels and the camera settle
        for _ in range(600):  # a moving picture is drawn coarsely where drawing is slow
            if self.run("foretouch.state().isAtRest"):
                break
            time.sleep(0.1)
        data = self.call("Page.captureScreenshot", format="png", optimizeForSpeed=False)["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))
