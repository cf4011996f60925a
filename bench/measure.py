"""Runs of lamina for the benchmarks: what they cost, medians, and tables.

Processor time is that of the whole process, from exec to its end, as the
system counts it. Runs that are to be compared take turns, so that a busy
machine slows all of them.
"""
import hashlib
import json
import os
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LAMINA = Path(os.environ.get("LAMINA", ROOT / "build/release/lamina"))
SCENES = ROOT / "bench/scenes"

# So that processor time is what a user waits for; Mesa's OpenGL in software
# draws in the calling thread too (LP_NUM_THREADS).
ONE_THREAD = ["--threads", "1"]
ENVIRONMENT = {"PATH": os.environ.get("PATH", ""), "LC_ALL": "C",
               "HOME": os.environ.get("HOME", ""), "LP_NUM_THREADS": "0"}


class Failure(Exception):
    """A run that ended with an error, or was stopped."""


class Stopped(Failure):
    """A run that took more than `seconds` of processor time."""

    def __init__(self, seconds):
        super().__init__(f"> {seconds:g}")
        self.seconds = seconds


def require_lamina():
    if not LAMINA.exists():
        sys.exit("build first: scripts/run --version")


@dataclass
class Cost:
    """What a run took, and what it printed."""
    seconds: float  # of processor time, of all its threads
    peak_bytes: int  # counts some of the caller's too: good for large ones only
    output: str


def run_process(command, limit, folder=None, environment=None):
    """The Cost of `command`, which runs in `folder` and is stopped after `limit`
    processor seconds (a whole number)."""
    with tempfile.TemporaryFile() as words:
        process = subprocess.Popen(
            command, cwd=folder, env={**ENVIRONMENT, **(environment or {})},
            stdout=words, stderr=words, stdin=subprocess.DEVNULL)
        resource.prlimit(process.pid, resource.RLIMIT_CPU, (limit, limit))
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        words.seek(0)
        output = words.read().decode(errors="replace").strip()
    seconds = usage.ru_utime + usage.ru_stime
    # The limit is checked on another clock, some per cent off this one.
    if process.returncode == -signal.SIGKILL and seconds >= 0.9 * limit:
        raise Stopped(limit)
    if process.returncode != 0:
        raise Failure(output or f"ended with {process.returncode}")
    return Cost(seconds, usage.ru_maxrss * 1024, output)


def designs_of(folder, digits="0123456789abcdef"):
    """The paths in `folder` of its designs, in order: of those the md5 of whose
    path begins with one of `digits`."""
    designs = sorted(path.relative_to(folder)
                     for path in folder.rglob("*.scad") if path.is_file())
    designs = [design for design in designs
               if hashlib.md5(os.fsencode(design)).hexdigest()[0] in digits]
    if not designs:
        sys.exit(f"no design in {folder}")
    return designs


def quantile(values, share):
    """The value that `share` of them do not exceed."""
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))]


def seconds_text(seconds):
    return f"{seconds:.4f}" if seconds < 10 else f"{seconds:.1f}"


def megabytes_text(count):
    return f"{count / 1e6:.1f}"


class Bench:
    """Runs lamina into a scratch folder of its own."""

    def __init__(self, runs, limit=120):
        self.runs = runs
        self.limit = limit  # seconds that a run may take
        self.failures = []
        self.folder = tempfile.TemporaryDirectory()
        self.scratch = Path(self.folder.name)

    def write(self, name, text):
        """A file in the scratch folder."""
        path = self.scratch / name
        path.write_text(text)
        return path

    def run_once(self, arguments):
        """The run's report, with its processor seconds as "process_seconds"."""
        report = self.scratch / "report.json"
        cost = run_process(
            [LAMINA, *arguments, "-q", "-o", self.scratch / "out.slc",
             "--report", report], self.limit)
        return {**json.loads(report.read_text()),
                "process_seconds": cost.seconds}

    def measure(self, commands, times=1, pick=statistics.median):
        """The median report of each of `commands` (lists of arguments), field
        by field, or what `pick` takes of the runs; a Failure for one that
        fails. `times` as many runs."""
        reports = [[] for _ in commands]
        failed = {}
        for _ in range(self.runs * times):
            for i, arguments in enumerate(commands):
                if i in failed:
                    continue
                try:
                    reports[i].append(self.run_once(arguments))
                except Failure as failure:
                    failed[i] = failure
                    self.failures.append(failure)
        return [failed[i] if i in failed else report_of(reports[i], pick)
                for i in range(len(commands))]


def report_of(reports, pick):
    return {key: pick(report[key] for report in reports)
            for key, value in reports[0].items()
            if isinstance(value, (int, float))}


def markdown(columns, rows):
    """A table as text; all columns but the first are numbers."""
    lines = [columns, ["---"] + ["--:"] * (len(columns) - 1), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


class Section:
    """A part of a document between <!-- begin NAME --> and <!-- end NAME -->,
    written by a benchmark."""

    def __init__(self, document, name):
        self.document = document
        self.begin = f"<!-- begin {name} -->\n"
        self.end = f"<!-- end {name} -->\n"

    def read(self):
        text = self.document.read_text()
        return text[text.index(self.begin) + len(self.begin):
                    text.index(self.end)]

    def write(self, content):
        text = self.document.read_text()
        before = text[:text.index(self.begin) + len(self.begin)]
        self.document.write_text(before + content +
                                 text[text.index(self.end):])
