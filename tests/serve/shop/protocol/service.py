"""`lamina serve` for tests: a folder of designs, the program, its answers."""

import collections
import http.client
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse

TESTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
EXAMPLES = os.path.join(TESTS, "..", "examples")
sys.path.insert(0, os.path.join(TESTS, "serve"))
from server_process import ServerProcess  # noqa: E402

BOX = "length = 4;  // [1:0.5:20]\ncube([length, 2, 3]);\n"
# Takes about a second of a processor for n = 1000; its volume is n.
BUSY = ("n = 1;  // [1:1000]\ncube([n, 1, 1 + len([for (i = [1 : n], j = [1 : 40],"
        " k = [1 : 100]) if (i < 0) 0])]);\n")

Answer = collections.namedtuple("Answer", "status headers body")


class UnixConnection(http.client.HTTPConnection):
    def __init__(self, path, timeout):
        super().__init__("localhost", timeout=timeout)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(self.timeout)
        self.sock.connect(self.path)


def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


class Service(ServerProcess):
    """Ready when it is made. `listen` is the path of a socket, or none for a port
    of this machine; `command` runs the program."""

    def __init__(self, lamina, root, *options, listen=None, command=(),
                 environment=None):
        self.port = None if listen else free_port()
        self.address = listen or f"127.0.0.1:{self.port}"
        self.process = subprocess.Popen(
            [*command, lamina, "serve", "--root", root, "--listen", self.address,
             *options],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            env={**os.environ, **(environment or {})})
        deadline = time.monotonic() + 20
        while not self.is_ready():
            if self.process.poll() is not None or time.monotonic() > deadline:
                self.close()
                raise RuntimeError("lamina serve does not start")
            time.sleep(0.02)

    def connection(self, source="127.0.0.1", timeout=60):
        if self.port is None:
            return UnixConnection(self.address, timeout)
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout,
                                          source_address=(source, 0))

    def is_ready(self):
        try:
            return self.get("/readyz").status == 200
        except OSError:
            return False

    def ask(self, method, path, body=None, source="127.0.0.1", **headers):
        """The answer by a connection of its own. Words of headers have a _ for a -."""
        connection = self.connection(source)
        try:
            connection.request(
                method, path, body,
                {name.replace("_", "-"): text for name, text in headers.items()})
            answer = connection.getresponse()
            return Answer(answer.status, answer.headers, answer.read())
        finally:
            connection.close()

    def get(self, path, **headers):
        return self.ask("GET", path, **headers)

    def post(self, path, order=None, **more):
        """`order` as JSON, or bytes as they are."""
        body = order if isinstance(order, bytes) else json.dumps(order or {})
        return self.ask("POST", path, body,
                        **{"Content_Type": "application/json", **more})

    def wait_for_volume(self, design, volume, seconds=20):
        """Until a change of a file has been seen. Raises TimeoutError."""
        deadline = time.monotonic() + seconds
        while abs((got := self.quote(design)["volume"]) - volume) > 1e-6:
            if time.monotonic() > deadline:
                raise TimeoutError(f"{got}, not {volume}")
            time.sleep(0.02)

    def quote(self, design, values=None, **order):
        """The quote. Raises AssertionError where there is none."""
        answer = self.post(f"/designs/{design}/quote",
                           {"values": values or {}, **order})
        if answer.status != 200:
            raise AssertionError(answer)
        return json.loads(answer.body)


def by_query(path, order):
    return f"{path}?order={urllib.parse.quote(json.dumps(order))}"


class ServiceTest(unittest.TestCase):
    """A folder of designs, and services that end with the test. `program` is
    lamina."""

    program = None
    designs = {"box.scad": BOX}

    def setUp(self):
        self.lamina = os.path.abspath(self.program)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.root = self.path("designs")
        os.mkdir(self.root)
        for name, text in self.designs.items():
            self.write(name, text)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(os.path.join(self.root, name), "w", encoding="utf-8") as file:
            file.write(text)

    def copy_examples(self, *names):
        """These, or all, with what they include."""
        for name in names or os.listdir(EXAMPLES):
            if name.endswith(".scad"):
                shutil.copy(os.path.join(EXAMPLES, name), self.root)
        shutil.copytree(os.path.join(EXAMPLES, "lib"),
                        os.path.join(self.root, "lib"))

    def serve(self, *options, **more):
        service = Service(self.lamina, self.root, *options, **more)
        self.addCleanup(service.close)
        return service

    def run_lamina(self, *words):
        """What the program itself prints."""
        return subprocess.run([self.lamina, *words], check=True, text=True,
                              cwd=self.root, stdout=subprocess.PIPE).stdout

    def assert_problem(self, answer, status):
        self.assertEqual(answer.status, status, answer)
        self.assertEqual(answer.headers["Content-Type"], "application/problem+json")
        problem = json.loads(answer.body)
        self.assertEqual(problem["status"], status)
        self.assertGreater(len(problem["title"]), 0)
        self.assertGreater(len(problem["detail"]), 0)
        return problem


def main():
    ServiceTest.program = sys.argv.pop(1)
    unittest.main()
