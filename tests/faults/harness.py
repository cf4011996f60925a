"""Runs lamina under a fault and judges what it leaves.

The rule: a run ends by itself, with status 0 or 1 (130 where a signal ended
it); it says why where it is not 0; under each target's name stands all of the
new output or what stood there before; and nothing else is left.
"""

import concurrent.futures
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

import jobs

LONGEST_RUN = 120  # seconds; a machine under load is slow
OLD = b"what stood here before\n"


def contents(path):
    """Bytes of a file, or of all files of a folder; None if nothing is there."""
    if os.path.isdir(path):
        return {name: contents(os.path.join(path, name))
                for name in sorted(os.listdir(path))}
    if not os.path.exists(path):
        return None
    with open(path, "rb") as file:
        return file.read()


def write(path, bytes_):
    with open(path, "wb") as file:
        file.write(bytes_)


def old_of(name):
    return jobs.OLD_FOLDER if name.endswith("/") else OLD


class Place:
    """The folder of one run: inputs, outputs, the program's temporary files."""

    def __init__(self, work, job, has_old):
        self.path = tempfile.mkdtemp(dir=work)
        os.chmod(self.path, 0o777)
        for folder in ("tmp", "out"):
            os.mkdir(self.file(folder))
            os.chmod(self.file(folder), 0o777)
        for name in job.inputs:
            os.makedirs(os.path.dirname(self.file(name)), exist_ok=True)
            write(self.file(name), jobs.INPUTS[os.path.basename(name)])
        for name in job.outputs if has_old else ():
            self.write(name, old_of(name))

    def write(self, name, wanted):
        """A file of these bytes, or a folder of such files."""
        if isinstance(wanted, bytes):
            write(self.file(name), wanted)
            return
        os.mkdir(self.file(name))
        for part, bytes_ in wanted.items():
            write(self.file(name + part), bytes_)

    def file(self, name):
        return os.path.join(self.path, name)

    def remove(self):
        for folder, _, _ in os.walk(self.path):
            os.chmod(folder, 0o777)
        shutil.rmtree(self.path, ignore_errors=True)


def _shape(value):
    """JSON without its numbers: times and memory differ from run to run."""
    if isinstance(value, dict):
        return {key: _shape(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_shape(part) for part in value]
    return isinstance(value, (int, float)) or value


def is_whole(name, found, wanted, status):
    """Whether that is the output; the report on a failure is another one."""
    if not name.endswith("report.json"):
        return found == wanted
    try:
        report = json.loads(found)
    except (TypeError, ValueError):
        return False
    return status != 0 or _shape(report) == _shape(json.loads(wanted))


class Harness:
    """Runs jobs under faults, counts what came of them, prints a table."""

    def __init__(self, lamina, shim, is_quick, times, threads, seed):
        self.is_quick = is_quick
        self.times = times
        self.random = random.Random(seed)
        self.work = tempfile.mkdtemp(prefix="lamina-faults-")
        os.chmod(self.work, 0o777)
        # Copies, for who may not enter the folder of the build, as /root.
        module = os.path.join(os.path.dirname(lamina), "lamina_text.so")
        self.lamina, self.shim, _ = (
            shutil.copy(file, self.work) for file in (lamina, shim, module))
        self.pool = concurrent.futures.ThreadPoolExecutor(threads)
        self.wanted = {}  # of each job: its outputs and what it prints ("-")
        self.broken = []
        self.left_out = []

    def close(self):
        self.pool.shutdown()
        shutil.rmtree(self.work, ignore_errors=True)

    # --- Without a fault -----------------------------------------------------

    def command(self, job):
        return [self.lamina] + job.words

    def environment(self, place, fault=None, changes=None):
        values = dict(os.environ, TMPDIR=place.file("tmp"), LC_ALL="C")
        if fault:
            values.update(LD_PRELOAD=self.shim, LAMINA_FAULT=fault)
        for name, value in (changes or {}).items():
            values.pop(name, None)
            if value is not None:
                values[name] = value.replace("{place}", place.path)
        return values

    def learn(self, job):
        """What a job makes where nothing is in its way."""
        if job.name in self.wanted:
            return
        place = Place(self.work, job, False)
        result = subprocess.run(
            self.command(job), cwd=place.path, capture_output=True,
            env=self.environment(place), stdin=subprocess.DEVNULL)
        wanted = {name: contents(place.file(name)) for name in job.outputs}
        place.remove()
        if result.returncode != 0 or None in wanted.values():
            sys.exit(f"{job.name} fails by itself: {result.stderr.decode()}")
        self.wanted[job.name] = dict(wanted, **{"-": result.stdout})

    def count_calls(self, job, calls, has_old=False):
        place = Place(self.work, job, has_old)
        values = self.environment(place, f"{calls} 0 errno 0")
        values["LAMINA_FAULT_COUNT"] = place.file("count")
        subprocess.run(self.command(job), cwd=place.path, env=values,
                       stdin=subprocess.DEVNULL, capture_output=True)
        count = int(contents(place.file("count")))
        place.remove()
        return count

    # --- Under a fault -------------------------------------------------------

    def run(self, job, fault=None, has_old=False, statuses=(0, 1), leaves=(),
            changes=None, prepare=None, before=None, during=None, after=None,
            wrap=(), streams=None, ends_well=None, excused=()):
        """What is wrong with one run; None if nothing is.

        fault      for the shim, see fault_shim.cpp
        has_old    whether older outputs stand where the new ones will
        leaves     names that may be left beside inputs and outputs
        changes    of the environment; None: unset
        prepare    called in the child before the program begins
        before     called with the place before the run; after: behind it
        during     called with process and place while it runs
        wrap       words before the program's
        streams    other arguments for Popen
        ends_well  True: the status must be 0; False: it must not be
        excused    libraries in which the program may crash
        """
        place = Place(self.work, job, has_old)
        try:
            if before:
                before(place)
            with open(place.file("tmp.err"), "wb") as errors, \
                    open(place.file("tmp.out"), "wb") as output:
                options = {"stdin": subprocess.DEVNULL, "stdout": output,
                           "stderr": errors, "preexec_fn": prepare}
                options.update(streams or {})
                process = subprocess.Popen(
                    list(wrap) + self.command(job), cwd=place.path,
                    env=self.environment(place, fault, changes), **options)
                if during:
                    during(process, place)
                try:
                    status = process.wait(LONGEST_RUN)
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.wait()
                    return "it hangs"
            if after:
                after(place)
            return self.judge(job, place, status, statuses, has_old, leaves,
                              ends_well, streams, excused)
        finally:
            place.remove()

    def judge(self, job, place, status, statuses, has_old, leaves, ends_well,
              streams, excused):
        words = contents(place.file("tmp.err")).decode("utf-8", "replace")
        told = f"status {status}: {words[:900].strip()}"
        crashes_elsewhere = status < 0 and any(f"/{library}" in words
                                               for library in excused)
        if status not in statuses and not crashes_elsewhere:
            return told
        if ends_well is not None and ends_well != (status == 0):
            return told
        if status == 1 and not words.strip() and not streams:
            return "status 1 without a word"
        for name in job.outputs:
            found = contents(place.file(name))
            wanted = self.wanted[job.name][name]
            if found is not None and is_whole(name, found, wanted, status):
                continue
            if status == 0 and job.may_warn and "warning: " in words:
                continue
            if status == 0 or found != (old_of(name) if has_old else None):
                return f"{name} is {'gone' if found is None else 'wrong'}, {told}"
        if status == 0 and job.prints and not streams and \
                contents(place.file("tmp.out")) != self.wanted[job.name]["-"]:
            return f"not all was printed, {told}"
        left = self.strays(job, place) - set(leaves)
        return f"it left {sorted(left)}, {told}" if left else None

    def strays(self, job, place):
        """What is neither input nor output."""
        known = {name.split("/")[0] for name in job.inputs}
        known |= {"tmp", "out", "tmp.err", "tmp.out"}
        known |= {name.rstrip("/") for name in job.outputs}
        found = set(os.listdir(place.path))
        for folder in ("out", "tmp"):
            if os.path.isdir(place.file(folder)):
                found |= {f"{folder}/{name}"
                          for name in os.listdir(place.file(folder))}
        return found - known

    # --- Many of them --------------------------------------------------------

    def some(self, places, most):
        """All of them; in a quick look no more than `most`, or times that."""
        places = list(places)
        most *= self.times
        if not self.is_quick or len(places) <= most:
            return places
        return self.random.sample(places, most)

    def leave_out(self, name, why):
        """A case that this machine cannot run is not run, and the table says so."""
        self.left_out.append(name)
        print(f"{name:<64}{0:>7}  NOT RUN: {why}", flush=True)

    def case(self, name, runs):
        """runs: (words that tell which it is, arguments of run())."""
        begin = time.monotonic()
        if not runs:
            self.broken.append(f"{name}: no place where the fault can strike")
        for _, arguments in runs:
            self.learn(arguments["job"])
        futures = [(words, self.pool.submit(self.run, **arguments))
                   for words, arguments in runs]
        broken = [f"{words}: {future.result()}" for words, future in futures
                  if future.result()]
        self.broken += broken
        outcome = f"{len(broken)} BROKEN" if broken else "whole or absent"
        print(f"{name:<64}{len(futures):>7}  {outcome:<16}"
              f"{time.monotonic() - begin:5.0f} s", flush=True)
        for line in broken[:8]:
            print("    " + line.replace("\n", "\n      "), flush=True)
