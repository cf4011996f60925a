"""A headless Chromium, driven through the DevTools protocol over pipes."""

import base64
import json
import os
import shutil
import struct
import subprocess
import tempfile
import time
import zlib


class Browser:
    """One page. Raises RuntimeError where Chromium or the page complains."""

    def __init__(self, width=1200, height=800, is_phone=False):
        program = shutil.which("chromium")
        if program is None:
            raise RuntimeError("chromium is not installed (Debian: chromium)")
        self.folder = tempfile.mkdtemp()
        to_browser, self.sink = os.pipe()
        self.source, from_browser = os.pipe()
        # The protocol's pipes are the descriptors 3 and 4.
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$0" "$@" 3<&{to_browser} 4>&{from_browser}',
             program, "--headless=new", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader",
             "--disable-dev-shm-usage", "--hide-scrollbars",
             "--remote-debugging-pipe", f"--user-data-dir={self.folder}",
             "about:blank"],
            pass_fds=(to_browser, from_browser), stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer = b""
        self.number = 0
        self.session = None
        self.faults = []
        self.requests = []
        target = next(t for t in self.call("Target.getTargets")["targetInfos"]
                      if t["type"] == "page")
        self.session = self.call("Target.attachToTarget",
                                 targetId=target["targetId"],
                                 flatten=True)["sessionId"]
        self.call("Runtime.enable")
        self.call("Network.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width,
                  height=height, deviceScaleFactor=1, mobile=is_phone)
        if is_phone:
            self.call("Emulation.setTouchEmulationEnabled", enabled=True)

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.sink)
        os.close(self.source)
        shutil.rmtree(self.folder, ignore_errors=True)

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.sink, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.read_message()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.take_event(answer)

    def read_message(self):
        while b"\0" not in self.buffer:
            piece = os.read(self.source, 1 << 20)
            if not piece:
                raise RuntimeError("chromium ended")
            self.buffer += piece
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def take_event(self, event):
        if event.get("method") == "Runtime.exceptionThrown":
            self.faults.append(event["params"]["exceptionDetails"])
        if event.get("method") == "Network.requestWillBeSent":
            self.requests.append(event["params"]["request"]["url"])

    # A page without scripts is ready when it is read; ours say it.
    READY = ("document.scripts.length === 0 || "
             "document.documentElement.dataset.ready === 'true'")

    def open(self, url, ready=READY):
        self.call("Page.navigate", url="about:blank")
        self.requests.clear()
        self.call("Page.navigate", url=url)
        deadline = time.monotonic() + 60
        while not self.evaluate(
                "location.href !== 'about:blank' && "
                f"document.readyState === 'complete' && ({ready})"):
            if time.monotonic() > deadline or self.faults:
                raise RuntimeError(f"{url} does not open: {self.faults}")
            time.sleep(0.02)
        self.settle()

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression,
                           awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"])
        return result["result"].get("value")

    def text(self, element):
        return self.evaluate(
            f"document.getElementById('{element}').textContent")

    def settle(self):
        """Waits until what has changed is drawn."""
        self.evaluate("new Promise((resolve) => requestAnimationFrame("
                      "() => requestAnimationFrame(resolve)))")

    def press(self, key, shift=False):
        # The browser itself takes Tab by its number alone.
        number = {"windowsVirtualKeyCode": 9} if key == "Tab" else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key,
                      modifiers=8 if shift else 0, **number)

    def click(self, x, y):
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y,
                      button="none" if kind == "mouseMoved" else "left",
                      clickCount=1)

    def move(self, x, y):
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y,
                  button="none")
        self.settle()

    def drag(self, start, end, shift=False):
        held = 8 if shift else 0
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=start[0],
                  y=start[1], button="left", clickCount=1, modifiers=held)
        for step in range(1, 5):
            self.call("Input.dispatchMouseEvent", type="mouseMoved",
                      x=start[0] + (end[0] - start[0]) * step / 4,
                      y=start[1] + (end[1] - start[1]) * step / 4,
                      button="left", buttons=1, modifiers=held)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=end[0],
                  y=end[1], button="left", clickCount=1, modifiers=held)

    def wheel(self, x, y, by):
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y,
                  deltaX=0, deltaY=by)
        self.settle()

    def place_of(self, element):
        """The element's left, top, width and height."""
        return self.evaluate(
            "(() => {const r = document.getElementById('%s')."
            "getBoundingClientRect(); return [r.x, r.y, r.width, r.height]})()"
            % element)

    def screenshot(self, path=None):
        data = base64.b64decode(
            self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            with open(path, "wb") as file:
                file.write(data)
        return Picture(data)


class Picture:
    """The pixels of a PNG file of 8 bits of RGB or RGBA."""

    def __init__(self, data):
        assert data[:8] == b"\x89PNG\r\n\x1a\n"
        place = 8
        packed = b""
        while place < len(data):
            size, kind = struct.unpack(">I4s", data[place:place + 8])
            body = data[place + 8:place + 8 + size]
            if kind == b"IHDR":
                self.width, self.height, depth, color = struct.unpack(
                    ">IIBB", body[:10])
                assert depth == 8 and color in (2, 6)
                self.channels = 3 if color == 2 else 4
            elif kind == b"IDAT":
                packed += body
            place += size + 12
        self.rows = self.unfilter(zlib.decompress(packed))

    def unfilter(self, data):
        step = self.channels
        length = self.width * step
        above = bytearray(length)
        rows = []
        for y in range(self.height):
            kind = data[y * (length + 1)]
            row = bytearray(data[y * (length + 1) + 1:(y + 1) * (length + 1)])
            for i in range(length if kind else 0):
                left = row[i - step] if i >= step else 0
                corner = above[i - step] if i >= step else 0
                row[i] = (row[i] + self.guess(kind, left, above[i], corner)) & 255
            rows.append(row)
            above = row
        return rows

    @staticmethod
    def guess(kind, left, up, corner):
        if kind == 1:
            return left
        if kind == 2:
            return up
        if kind == 3:
            return (left + up) // 2
        estimate = left + up - corner
        return min((left, up, corner), key=lambda value: abs(estimate - value))

    def at(self, x, y):
        begin = int(x) * self.channels
        return tuple(self.rows[int(y)][begin:begin + 3])
