"""examples/serve/lamina-serve.service, as far as it can be judged without systemd
as the system's first process: what systemd-analyze says of it, and whether what
the program does, as strace sees it, is within what the unit allows.

usage: unit_test.py LAMINA [unittest's arguments]
"""

import contextlib
import os
import re
import shlex
import signal
import subprocess

from web_server import SERVE, service
from server_process import children

UNIT = os.path.join(SERVE, "lamina-serve.service")


def settings(name):
    """All values of a setting of the unit, in its order."""
    with open(UNIT, encoding="utf-8") as file:
        return re.findall(rf"^{name}=(.*)$", file.read(), re.MULTILINE)


def calls_of(group):
    """The system calls of one of systemd's groups, and of the groups in it."""
    text = subprocess.run(["systemd-analyze", "syscall-filter", group], check=True,
                          text=True, stdout=subprocess.PIPE).stdout
    calls = set()
    for word in re.findall(r"^    (\S+)", text, re.MULTILINE):
        calls |= calls_of(word) if word[0] == "@" else {word}
    return calls


def allowed_calls():
    allowed = set(calls_of("@default"))
    for line in settings("SystemCallFilter"):
        for word in line.removeprefix("~").split():
            calls = calls_of(word) if word[0] == "@" else {word}
            allowed = allowed - calls if line[0] == "~" else allowed | calls
    return allowed


class UnitTest(service.ServiceTest):
    designs = {"box.scad": service.BOX,
               "text.scad": 'words = "Ada";\nlinear_extrude(1) text(words);\n',
               "busy.scad": service.BUSY}

    def analyze(self, *words):
        return subprocess.run(["systemd-analyze", *words], text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_is_a_unit_for_systemd(self):
        with open(UNIT, encoding="utf-8") as file:
            text = file.read()
        self.assertEqual(text.count("/usr/bin/lamina"), 1)
        path = self.path("lamina-serve.service")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("/usr/bin/lamina", self.lamina))
        checked = self.analyze("verify", "--man=no", path)
        self.assertEqual((checked.returncode, checked.stdout), (0, ""))

    def test_gives_nearly_no_rights(self):
        checked = self.analyze("security", "--offline=true", "--threshold=10", UNIT)
        self.assertEqual(checked.returncode, 0, checked.stdout)

    def test_waits_longer_than_the_program_does(self):
        self.assertGreater(int(settings("TimeoutStopSec")[0]), 30)
        self.assertEqual(settings("KillMode"), ["mixed"])

    def test_allows_what_the_program_does(self):
        lines = self.trace()
        calls = {match[1] for line in lines
                 if (match := re.match(r"\d+ +(\w+)\(", line))}
        self.assertGreater(len(calls), 30)
        self.assertEqual(calls - allowed_calls(), set())
        for line in lines:
            # RestrictAddressFamilies, RestrictNamespaces
            self.assertNotRegex(line, r" socket\((?!AF_UNIX)")
            self.assertNotRegex(line, r"CLONE_NEW| (unshare|setns)\(")

    def end(self, pid):
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)

    def trace(self):
        """What the program and its orders of all kinds ask the system for."""
        log = self.path("trace")
        with open(UNIT, encoding="utf-8") as file:
            words = shlex.split(re.search(r"^ExecStart=((?:.*\\\n)*.*)$", file.read(),
                              re.MULTILINE)[1].replace("\\\n", ""))
        options = words[words.index("/run/lamina/socket") + 1:]
        running = self.serve(*options, "--max-time", "20", listen=self.path("socket"),
                             command=["strace", "-f", "-qq", "-o", log])
        traced = children(running.process.pid)[0]
        self.addCleanup(self.end, traced)
        for design in ("box", "text"):
            for kind in ("quote", "layers?format=slc", "page", "picture.png"):
                answer = running.post(f"/designs/{design}/{kind}")
                self.assertEqual(answer.status, 200, answer)
        self.assertEqual(running.post("/designs/box/quote", {
            "supports": True, "sprue": True, "minFeature": 0.3}).status, 200)
        self.write("box.scad", service.BOX.replace("2, 3", "2, 5"))
        running.wait_for_volume("box", 40)
        running.get("/metrics")
        os.kill(traced, signal.SIGTERM)
        self.assertEqual(running.process.wait(timeout=40), 0)
        with open(log, encoding="utf-8", errors="replace") as file:
            return file.readlines()


if __name__ == "__main__":
    service.main()
