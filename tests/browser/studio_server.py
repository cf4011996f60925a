"""A stand-in for the program behind the studio's page (docs/studio.md).

It makes bars instead of designs: `size` mm long, `width` mm wide, 10 mm high, so
that all that the page shows of a choice is known. It answers late and in any order
where it is asked to.

usage: studio_server.py [PORT]    serves until it is killed
"""

import base64
import copy
import difflib
import html
import json
import os
import queue
import random
import re
import sys
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
VIEWER = os.path.join(ROOT, "slicer", "picture", "viewer")
PAGE = os.path.join(ROOT, "serve", "studio", "page")


def scripts_of(folder, variable):
    """The scripts that the build puts one behind another."""
    with open(os.path.join(folder, "..", "CMakeLists.txt"),
              encoding="utf-8") as file:
        listed = file.read().split(f"read_texts({variable}")[1].split(")")[0]
    return re.findall(r"[a-z]+\.js", listed)


VIEWER_SCRIPTS = scripts_of(VIEWER, "LAMINA_VIEWER_SCRIPT")
PAGE_SCRIPTS = scripts_of(PAGE, "LAMINA_STUDIO_SCRIPT")

POLICY = ("default-src 'none'; script-src 'self'; style-src 'self'; "
          "img-src 'self' data:; connect-src 'self'; base-uri 'none'; "
          "form-action 'none'; frame-ancestors 'none'")

STEP = 0.001
HEIGHT = 10

PARAMETERS = [
    {"name": "size", "caption": "ring size", "group": "Size", "type": "number",
     "initial": 54.0, "min": 10.0, "max": 90.0, "step": 1.0},
    {"name": "width", "caption": "width at the back [mm]", "group": "Size",
     "type": "number", "initial": 20.0},
    {"name": "shape", "caption": "shape of the band", "group": "Size",
     "type": "string", "initial": "round",
     "options": [{"name": "Round", "value": "round"},
                 {"name": "Flat", "value": "flat"},
                 {"name": "Knife edge", "value": "knife"}]},
    {"name": "prongs", "group": "Stone", "type": "number", "initial": 6.0,
     "options": [{"name": "4", "value": 4.0}, {"name": "6", "value": 6.0}]},
    {"name": "has_stone", "caption": "show the stone", "group": "Stone",
     "type": "boolean", "initial": False},
    {"name": "holes", "caption": "places of the holes [mm]", "group": "Stone",
     "type": "number", "initial": [1.0, 2.5, 4.0], "min": 0.0, "max": 9.0,
     "step": 0.5},
    {"name": "initials", "caption": "one to three letters", "group": "Engraving",
     "type": "string", "initial": "LM", "maxLength": 3},
    {"name": "face", "caption": "font", "group": "Engraving", "type": "string",
     "initial": "Liberation Sans", "widget": "font"},
    {"name": "metal_color", "caption": "color", "group": "Engraving",
     "type": "string", "initial": "gold", "widget": "color"},
    {"name": "secret", "group": "Engraving", "type": "number", "initial": 1.0,
     "step": 1.0, "widget": "hidden"},
    {"name": "finish", "caption": "finish of all", "group": "Global",
     "type": "string", "initial": "matte"},
]

SETTINGS = {"layer": 0.5, "minFeature": 0, "supports": False, "printer": "",
            "material": "", "metal": ""}

METALS = [("silver-925", "Silver 925", 10.36), ("gold-585", "Gold 585", 13.1),
          ("gold-750", "Gold 750", 15.4), ("platinum-950", "Platinum 950", 20.1)]


def text_of(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "[" + ", ".join(f"{number:g}" for number in value) + "]"
    return value if isinstance(value, str) else f"{value:g}"


def zigzag(value):
    return -2 * value - 1 if value < 0 else 2 * value


def stream(numbers):
    """Integers as the page reads them: 7 bits a byte, low ones first."""
    data = bytearray()
    for number in numbers:
        while number >= 0x80:
            data.append(0x80 | (number & 0x7F))
            number >>= 7
        data.append(number)
    return base64.b64encode(bytes(data)).decode()


class Bar:
    """The layers of a box around the origin."""

    def __init__(self, size, width, layer):
        self.size, self.width = size, width
        self.count = max(1, round(HEIGHT / layer))
        self.thickness = HEIGHT / self.count
        self.low = [-size / 2, -width / 2]
        self.high = [size / 2, width / 2]

    def row(self, index):
        bottom = index * self.thickness
        return [bottom + self.thickness / 2, bottom, bottom + self.thickness, 1, 0,
                4, self.size * self.width, 2 * (self.size + self.width)]

    def contours(self, count):
        """The loop of that many layers, as steps in units of STEP."""
        x, y = round(self.size / STEP), round(self.width / STEP)
        numbers = []
        place = (0, 0)
        for _ in range(count):
            numbers += [1, 4]
            for corner in [(0, 0), (x, 0), (x, y), (0, y)]:
                numbers += [zigzag(corner[0] - place[0]), zigzag(corner[1] - place[1])]
                place = corner
        return stream(numbers)

    def layer_event(self, z):
        index = self.count // 2 if z is None else min(
            self.count - 1, max(0, int(z / self.thickness)))
        return {"index": index, "count": self.count, "row": self.row(index),
                "bottom": 0, "low": self.low, "high": self.high, "step": STEP,
                "contours": self.contours(1)}

    def part_event(self, title):
        return {"contours": self.contours(self.count), "facts": {
            "title": title, "estimate": "", "low": self.low, "high": self.high,
            "step": STEP, "volume": self.volume(), "minFeature": 0,
            "layers": [self.row(i) for i in range(self.count)]}}

    def volume(self):
        return self.size * self.width * HEIGHT

    def report_event(self):
        return {"size": [self.size, self.width, HEIGHT], "volume": self.volume(),
                "estimate": "castable, 1.2 ml, 2 h 10 min, 3.40 €",
                "metals": [{"name": name, "title": title,
                            "grams": self.volume() * density / 1000}
                           for name, title, density in METALS]}


class Client:
    def __init__(self, name):
        self.name = name
        self.events = queue.Queue()
        self.number = 0


class Studio:
    """What the program knows. All of it may be changed while it runs.

    delays: range of the time before layer and part come [s]
    ends_runs: whether a later choice ends a run, as it should
    """

    def __init__(self):
        self.lock = threading.Lock()
        self.clients = {}
        self.designs = ["ring.scad", "hoop.scad"]
        self.parameters = copy.deepcopy(PARAMETERS)
        self.sets = [{"name": "wide", "values": {"size": "60", "width": "30"}}]
        self.messages = []
        self.fails = False
        self.delays = (0, 0)
        self.ends_runs = True
        self.changes = []  # choices that came
        self.outputs = []
        self.made = 0      # files and clients
        self.server = None
        self.port = 0

    # The server

    def start(self):
        studio = self

        class Handler(RequestHandler):
            pass
        Handler.studio = studio

        class Server(ThreadingHTTPServer):
            daemon_threads = True
            allow_reuse_address = True

            def handle_error(self, request, client_address):
                pass
        self.server = Server(("127.0.0.1", self.port), Handler)
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, args=(0.02,),
                         daemon=True).start()
        return f"http://127.0.0.1:{self.port}/"

    def stop(self):
        """Ends all connections, and forgets who was there."""
        self.server.shutdown()
        self.server.server_close()
        with self.lock:
            for client in self.clients.values():
                client.events.put(None)
            self.clients = {}

    # Designs

    def key(self):
        return f"{hash(json.dumps(self.parameters)) & 0xffffff:06x}"

    def source(self, parameters):
        return [f"{p['name']} = {json.dumps(p['initial'])};\n" for p in parameters]

    def with_values(self, values):
        parameters = copy.deepcopy(self.parameters)
        for parameter in parameters:
            if parameter["name"] in values:
                text = values[parameter["name"]]
                parameter["initial"] = (text if parameter["type"] == "string"
                                        else json.loads(text))
        return parameters

    def edit(self, parameters):
        """Changes the file."""
        self.parameters = parameters
        self.tell_all({"kind": "changed", "files": ["ring.scad"]})

    def tell_all(self, event):
        with self.lock:
            for client in self.clients.values():
                client.events.put(event)

    # Runs

    def connect(self):
        with self.lock:
            self.made += 1
            client = Client(f"client-{self.made}")
            self.clients[client.name] = client
        client.events.put({
            "kind": "hello", "client": client.name, "version": "0.1.0",
            "designs": self.designs, "design": self.designs[0],
            "settings": SETTINGS, "printers": ["saturn4", "mars3"],
            "materials": ["castable"], "metals": [name for name, _, _ in METALS],
            "formats": [{"name": "slc", "title": "SLC: layers for casting machines"},
                        {"name": "stl", "title": "STL"},
                        {"name": "bad", "title": "A format that fails"}]})
        return client

    def change(self, choice):
        client = self.clients.get(choice["client"])
        if client is None or choice["design"] not in self.designs:
            return False
        with self.lock:
            self.changes.append(choice)
            client.number = max(client.number, choice["number"])
        threading.Thread(target=self.run, args=(client, choice), daemon=True).start()
        return True

    def run(self, client, choice):
        begin = time.monotonic()
        number = choice["number"]
        bar = self.bar_of(choice)

        def tell(kind, event):
            if self.ends_runs and client.number != number:
                return
            client.events.put({"kind": kind, "number": number, **event})
        if choice["form"] != self.key():
            tell("form", {"key": self.key(), "parameters": self.parameters,
                          "sets": self.sets})
        tell("messages", {"messages": self.messages})
        if self.fails:
            tell("end", {"isWell": False, "milliseconds": {"layer": 0, "all": 0}})
            return
        time.sleep(random.uniform(*self.delays))
        tell("layer", bar.layer_event(choice["z"]))
        layer = time.monotonic() - begin
        time.sleep(random.uniform(*self.delays))
        tell("part", bar.part_event(choice["design"]))
        tell("report", bar.report_event())
        tell("end", {"isWell": True, "milliseconds": {
            "layer": 1000 * layer, "all": 1000 * (time.monotonic() - begin)}})

    def bar_of(self, choice):
        values = {p["name"]: p["initial"] for p in self.with_values(choice["values"])}
        return Bar(values.get("size", 10), values.get("width", 20),
                   choice["settings"]["layer"])

    def answer(self, path, choice):
        """Status and body of what is asked beside runs."""
        if choice["client"] not in self.clients:
            return 404, "unknown client"
        if path == "/output":
            if choice["format"] == "bad":
                return 422, {"messages": [{"severity": "error", "text": "",
                                           "message": "This format cannot hold it"}]}
            self.outputs.append(choice)
            return 200, {"file": f"/file/{len(self.outputs)}",
                         "name": f"ring.{choice['format']}"}
        written = self.with_values(choice["values"])
        if "key" not in choice:
            return 200, {"key": self.key(), "diff": "".join(difflib.unified_diff(
                self.source(self.parameters), self.source(written), "ring.scad",
                "ring.scad", n=1))}
        if choice["key"] != self.key():
            return 409, "ring.scad has changed"
        self.edit(written)
        return 200, {"written": "ring.scad"}


def page():
    def part(name):
        with open(os.path.join(PAGE, name), encoding="utf-8") as file:
            return file.read()
    with open(os.path.join(VIEWER, "page.html"), encoding="utf-8") as file:
        text = file.read()
    for mark, piece in [
            ("title", html.escape("ring.scad")),
            ("head", '<link rel="icon" href="data:,">'
                     '<link rel="stylesheet" href="/studio.css">'),
            ("tools", part("tools.html")), ("panel", part("panel.html")),
            ("tail", '<script src="/studio.js"></script>')]:
        assert text.count("{{" + mark + "}}") == 1
        text = text.replace("{{" + mark + "}}", piece)
    return text


def joined(*files):
    texts = []
    for path in files:
        with open(path, encoding="utf-8") as file:
            texts.append(file.read())
    return "".join(texts)


def script():
    return '"use strict";\n' + joined(
        *[os.path.join(VIEWER, name) for name in VIEWER_SCRIPTS],
        *[os.path.join(PAGE, name) for name in PAGE_SCRIPTS])


def style():
    return joined(os.path.join(VIEWER, "style.css"), os.path.join(PAGE, "studio.css"))


class RequestHandler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    studio = None

    def log_message(self, *_):
        pass

    def send(self, status, kind, body):
        data = body if isinstance(body, bytes) else body.encode()
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(data)))
        self.send_header("Content-Security-Policy", POLICY)
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(data)

    def do_GET(self):
        if self.path == "/":
            self.send(200, "text/html; charset=utf-8", page())
        elif self.path == "/studio.js":
            self.send(200, "text/javascript; charset=utf-8", script())
        elif self.path == "/studio.css":
            self.send(200, "text/css; charset=utf-8", style())
        elif self.path == "/events":
            self.send_events()
        elif self.path.startswith("/file/"):
            choice = self.studio.outputs[int(self.path[len("/file/"):]) - 1]
            self.send(200, "application/octet-stream", json.dumps(choice))
        else:
            self.send(404, "text/plain", "not here")

    def send_events(self):
        client = self.studio.connect()
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        while (event := client.events.get()) is not None:
            try:
                self.wfile.write(f"data: {json.dumps(event)}\n\n".encode())
                self.wfile.flush()
            except OSError:
                break
        self.studio.clients.pop(client.name, None)

    def do_POST(self):
        body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        if self.path == "/change":
            is_known = self.studio.change(body)
            self.send(202 if is_known else 404, "text/plain",
                      "" if is_known else "unknown client or design")
        elif self.path in ("/output", "/source"):
            status, answer = self.studio.answer(self.path, body)
            if isinstance(answer, str):
                self.send(status, "text/plain; charset=utf-8", answer)
            else:
                self.send(status, "application/json", json.dumps(answer))
        else:
            self.send(404, "text/plain", "not here")


if __name__ == "__main__":
    studio = Studio()
    studio.port = int(sys.argv[1]) if len(sys.argv) > 1 else 0
    print(studio.start(), flush=True)
    threading.Event().wait()
