"""One run of lamina in a scratch folder, under limits, and its judgement."""
import os
import re
import shutil
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import corpus

# What may come on top of a limit: seconds until the program has looked at the
# clock and given back its memory, of a machine that has nothing else to do;
# bytes until it has looked at its memory.
TIME_SLACK = 2
MEMORY_SLACK = 200 << 20
# Seconds after the limit in which a run is stopped.
STOP = 300


def time_slack():
    return TIME_SLACK * max(1, os.getloadavg()[0] / os.cpu_count())

# Words of a C++ library, not of ours.
RAW = re.compile(rb"internal error|\bstd::|bad_alloc|terminate called|"
                 rb"basic_string|\bvector::|out_of_range|what\(\)|Sanitizer")

# A line of the design that a message shows; what stands there is the design's.
SHOWN = re.compile(rb"^ *\d+ \|.*$", re.MULTILINE)

GOOD = ("exit 0", "exit 1")
BAD = ("exit 2", "other exit", "signal", "over time", "over memory",
       "no words", "raw words", "no output", "leftovers")


@dataclass(frozen=True)
class Limits:
    seconds: int
    megabytes: int

    def options(self):
        return ["--max-time", str(self.seconds),
                "--max-memory", f"{self.megabytes}M"]


@dataclass
class Result:
    outcome: str  # one of GOOD or BAD
    seconds: float  # by the clock
    processor_seconds: float
    peak_bytes: int
    words: str
    command: list
    design: str  # made for the run
    tree: Path

    @property
    def options(self):
        """The command without the files."""
        return " ".join(word if "/" not in word else Path(word).suffix
                        for word in self.command[1:])

    @property
    def line(self):
        """The command for the files where they are installed."""
        return " ".join(self.command).replace(str(self.tree),
                                              str(corpus.DATA))


class Sandbox:
    """A copy of the data and an output folder, for one run after another."""

    def __init__(self, folder, lamina, limits):
        self.lamina = lamina
        self.limits = limits
        self.folder = Path(folder)
        self.tree = self.folder / "tree"
        self.designs = self.folder / "designs"
        self.temporary = self.folder / "tmp"
        self.out = self.folder / "out"
        self.words = self.folder / "words"
        for each in (self.tree, self.designs, self.temporary, self.out):
            each.mkdir()
        corpus.copy_tree(self.tree)
        self.files = self.listing()

    def listing(self):
        """Size of every file of the copy."""
        return {path: path.stat().st_size
                for path in sorted(self.tree.rglob("*")) if path.is_file()}

    def put(self, path, data):
        (self.tree / path).write_bytes(data)

    def run(self, run, options=()):
        """Runs lamina in limits."""
        text = corpus.place(run.design, self.tree, self.designs)
        (self.designs / "design.scad").write_text(text)
        output = self.out / f"out.{run.ending}"
        command = [str(self.lamina), *run.words(self.tree, self.designs),
                   "-o", str(output), *options, *self.limits.options()]
        began = time.monotonic()
        status, usage = self.execute(command)
        seconds = time.monotonic() - began
        peak = usage.ru_maxrss * 1024
        outcome = (self.limit_passed(seconds, peak) or
                   self.judged(status, output))
        with open(self.words, "rb") as file:
            said = file.read(2000).decode(errors="replace")
        self.clear()
        return Result(outcome, seconds, usage.ru_utime + usage.ru_stime, peak,
                      said, command, text, self.tree)

    def execute(self, command):
        """Exit status and usage."""
        environment = {"PATH": os.environ.get("PATH", ""), "LC_ALL": "C.UTF-8",
                       "HOME": os.environ.get("HOME", ""),
                       "TMPDIR": str(self.temporary),
                       "OPENSCADPATH": str(self.tree / "libraries")}
        with open(self.words, "wb") as words:
            process = subprocess.Popen(command, env=environment,
                                       stdin=subprocess.DEVNULL, stdout=words,
                                       stderr=words, cwd=self.folder)
            stop = threading.Timer(self.limits.seconds + STOP, process.kill)
            stop.start()
            _, status, usage = os.wait4(process.pid, 0)
            stop.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
        return process.returncode, usage

    def limit_passed(self, seconds, peak):
        """The limit that was passed; nothing where both held."""
        if seconds > self.limits.seconds + time_slack():
            return "over time"
        if peak > (self.limits.megabytes << 20) + MEMORY_SLACK:
            return "over memory"
        return ""

    def judged(self, status, output):
        words = self.words.read_bytes()
        left = [path for folder in (self.out, self.temporary)
                for path in folder.iterdir() if path != output]
        if status < 0:
            return "signal"
        if status not in (0, 1):
            return "exit 2" if status == 2 else "other exit"
        if RAW.search(SHOWN.sub(b"", words)):
            return "raw words"
        # The .echo of a design that is at fault holds its messages.
        if left or (status == 1 and output.exists() and
                    output.suffix != ".echo"):
            return "leftovers"
        if status == 0 and not output.exists():
            return "no output"
        if status == 1 and not words.strip():
            return "no words"
        return f"exit {status}"

    def clear(self):
        for folder in (self.out, self.temporary):
            for path in folder.iterdir():
                shutil.rmtree(path) if path.is_dir() else path.unlink()

    def strays(self):
        """Files of the copy that runs made, changed or took away."""
        now = self.listing()
        return sorted(str(path) for path, _ in
                      now.items() ^ self.files.items())
