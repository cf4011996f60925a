"""The faults, one function for each kind; each runs the cases that it names."""

import ctypes
import errno
import itertools
import os
import resource
import shutil
import signal
import stat
import subprocess
import time

import jobs
from harness import contents, write

MIB = 1 << 20

# The calls by which outputs come to the disk.
OUTPUT_CALLS = "write,pwrite,openat,open,linkat,rename,renameat2,mkdir,close"

# Each call, with the errors that it is made to have.
CALL_ERRORS = {
    "write": ["ENOSPC", "EIO"],
    "pwrite": ["ENOSPC", "EDQUOT"],
    "open": ["EIO", "EMFILE"],
    "openat": ["ENOSPC", "EMFILE"],
    "mkdir": ["ENOSPC"],
    "linkat": ["EPERM", "ENOSPC", "EIO"],
    "rename": ["ENOSPC", "EIO"],
    "renameat2": ["EINVAL"],
    "flock": ["ENOLCK"],
    "close": ["EIO", "ENOSPC"],
    "fcntl": ["EMFILE"],
    "lseek": ["EIO"],
    "read": ["EIO"],
    "pread": ["EIO"],
    "fstat": ["EIO"],
    "stat": ["ENOMEM"],
    "realpath": ["ENOMEM"],
    "fopen": ["EMFILE"],
    "opendir": ["EMFILE"],
    "mmap": ["ENOMEM"],
    "mremap": ["ENOMEM"],
    "pthread_create": ["EAGAIN"],
    "dlopen": ["ENOMEM"],
}


def _both(harness):
    """Whether older outputs stand there: both, or in a quick run one."""
    return harness.some((False, True), 1)


def failing_calls(harness):
    """Each call of each job fails once, and in other runs from then on."""
    for call, errors in CALL_ERRORS.items():
        runs = []
        for job in harness.some(jobs.QUICK, 3):
            for has_old in _both(harness):
                for k in range(harness.count_calls(job, call, has_old)):
                    for error in errors:
                        for more in ("", "+"):
                            fault = (f"{call} {k + 1}{more} errno "
                                     f"{getattr(errno, error)}")
                            # A folder that cannot be opened stays hidden.
                            leaves = job.hidden() if call == "openat" else ()
                            runs.append((f"{job.name}, old: {has_old}, {fault}",
                                         dict(job=job, fault=fault,
                                              has_old=has_old, leaves=leaves)))
        if runs:
            harness.case(f"{call}() fails: {', '.join(errors)}",
                         harness.some(runs, 5))
    _folders_that_tell_nothing(harness)


def _folders_that_tell_nothing(harness):
    """A new folder that could not be looked at was once taken for another
    run's, and the next name tried, without end."""
    job = jobs.named("png")
    faults = [f"fstat {k + 1}{more} errno {errno.EIO}"
              for k in range(harness.count_calls(job, "fstat", False))
              for more in ("", "+")]
    harness.case("fstat() fails: EIO, of an output that is a folder",
                 [(fault, dict(job=job, fault=fault)) for fault in faults])


# Libraries that crash, or end the program, where an allocation fails.
ENDED_BY_MEMORY = ("libfontconfig", "libglib")


def failing_memory(harness):
    most = 40 * harness.times if harness.is_quick else 4000
    for more, words in (("", "one allocation fails"),
                        ("+", "all allocations fail from one on")):
        runs = []
        for job in harness.some(jobs.QUICK, 6):
            excused = ENDED_BY_MEMORY
            if job.name in ("zip", "sl1", "3mf"):
                excused += ("lamina(",)  # minizip is linked into it
            for k in range(harness.count_calls(job, "malloc")):
                fault = f"malloc {k + 1}{more} errno {errno.ENOMEM}"
                # Without memory a good word may look like a bad one: 2.
                runs.append((f"{job.name}, {fault}", dict(
                    job=job, fault=fault, statuses=(0, 1, 2),
                    excused=excused,
                    leaves=job.hidden() if job.makes_folders() else ())))
        if len(runs) > most:
            runs = harness.random.sample(runs, most)
        harness.case(words, runs)


def limits(harness):
    def limited(kind, value):
        return lambda: resource.setrlimit(kind, (value, value))

    # Where the program's libraries cannot be loaded, the loader ends it: 127.
    table = [
        ("address space of 10 to 400 MiB", resource.RLIMIT_AS,
         range(10 * MIB, 400 * MIB, 7 * MIB), (0, 1, 127)),
        ("data of 1 to 60 MiB", resource.RLIMIT_DATA,
         range(MIB, 60 * MIB, MIB), (0, 1, 127)),
        ("files of 0.5 to 4 kB at most (RLIMIT_FSIZE)", resource.RLIMIT_FSIZE,
         range(512, 4096, 97), (0, 1)),  # messages go to files, too
        ("3 to 12 open files at most", resource.RLIMIT_NOFILE, range(3, 13),
         (0, 1, 127)),
    ]
    for words, kind, values, statuses in table:
        runs = [(f"{job.name}, {value}",
                 dict(job=job, prepare=limited(kind, value), statuses=statuses))
                for job in jobs.QUICK for value in values
                # Its messages are files, too.
                if kind != resource.RLIMIT_FSIZE or not job.prints]
        if not harness.is_quick and len(runs) > 600:
            runs = harness.random.sample(runs, 600)
        harness.case(words, harness.some(runs, 6))
    # Limits of processes do not bind the superuser.
    runs = [(job.name, dict(job=job, prepare=_be_nobody, wrap=[
        "bash", "-c", "ulimit -u 0; exec \"$@\"", "bash"]))
        for job in jobs.SLOW[:2] + jobs.QUICK]
    harness.case("no thread but one (RLIMIT_NPROC)", harness.some(runs, 2))


NOBODY = 65534


def _be_nobody():
    if os.geteuid() == 0:
        os.setgroups([])
        os.setresgid(NOBODY, NOBODY, NOBODY)
        os.setresuid(NOBODY, NOBODY, NOBODY)


# --- The end comes from outside ------------------------------------------------


def kills(harness):
    begun, replaced, cleaned = [], [], []
    for job in harness.some(jobs.QUICK, 4):
        for k in range(harness.count_calls(job, OUTPUT_CALLS)):
            fault = f"{OUTPUT_CALLS} {k + 1} kill 9"
            arguments = dict(job=job, fault=fault, statuses=(0, -9))
            begun.append((f"{job.name}, {fault}", dict(
                arguments,
                leaves=job.hidden() if job.makes_folders() else ())))
        for k in range(harness.count_calls(job, OUTPUT_CALLS, True)):
            fault = f"{OUTPUT_CALLS} {k + 1} kill 9"
            arguments = dict(job=job, fault=fault, statuses=(0, -9),
                             has_old=True)
            replaced.append((f"{job.name}, {fault}",
                             dict(arguments, leaves=job.hidden())))
            cleaned.append((f"{job.name}, {fault}",
                            dict(arguments, after=_run_again(harness, job))))
    harness.case("kill -9 before each call, new outputs", harness.some(begun, 8))
    harness.case("kill -9 before each call, outputs replaced",
                 harness.some(replaced, 8))
    harness.case("what kill -9 left, after the next run",
                 harness.some(cleaned, 6))
    _strike(harness, "kill -9 at random", signal.SIGKILL, (0, -9))


def _run_again(harness, job):
    def after(place):
        subprocess.run(harness.command(job), cwd=place.path,
                       env=harness.environment(place), capture_output=True,
                       stdin=subprocess.DEVNULL, check=True)
    return after


def _strike(harness, words, number, statuses):
    """A signal at any moment of runs that take long enough."""
    seconds = {}

    def strike(delay):
        def during(process, _):
            time.sleep(delay)
            process.send_signal(number)
        return during

    runs = []
    for i in range(6 * harness.times if harness.is_quick else 300):
        job = jobs.SLOW[(i if not harness.is_quick
                         else harness.random.randrange(99)) % len(jobs.SLOW)]
        if job.name not in seconds:
            harness.learn(job)
            begin = time.monotonic()
            harness.run(job)
            seconds[job.name] = time.monotonic() - begin
        delay = harness.random.uniform(0, seconds[job.name])
        runs.append((f"{job.name}, after {delay:.3f} s", dict(
            job=job, has_old=i % 2 == 1, during=strike(delay),
            statuses=statuses,
            leaves=job.hidden() if number == signal.SIGKILL else ())))
    harness.case(words, runs)


def signals(harness):
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        number = getattr(signal, name)
        # Before the program's first step the system ends it.
        _strike(harness, f"{name} at random", number, (0, 130, -number))
        runs = []
        for job in harness.some(jobs.QUICK, 2):
            for k in range(harness.count_calls(job, OUTPUT_CALLS)):
                fault = f"{OUTPUT_CALLS} {k + 1} kill {int(number)}"
                runs.append((f"{job.name}, {fault}", dict(
                    job=job, fault=fault, statuses=(0, 130, -number))))
        harness.case(f"{name} before each call", harness.some(runs, 4))


# --- The disk ------------------------------------------------------------------


def full_disk(harness):
    """A file system of a few pages, in a name space of our own."""
    unshare = ["unshare", "-m" if os.geteuid() == 0 else "-rm"]
    can_mount = subprocess.run(
        unshare + ["mount", "-t", "tmpfs", "none", "/mnt"],
        capture_output=True).returncode == 0
    if not can_mount:
        harness.leave_out("a disk of 4 to 64 kB",
                          "nothing can be mounted here")
        return
    script = ("mount -t tmpfs -o size={}k none out && \"$@\"; s=$?; "
              "cp -a out/. kept/; exit $s")

    def after(place):
        shutil.rmtree(place.file("out"))
        os.rename(place.file("kept"), place.file("out"))

    runs = [(f"{job.name}, {size} kB", dict(
        job=job, wrap=unshare + ["sh", "-c", script.format(size), "sh"],
        before=lambda place: os.mkdir(place.file("kept")), after=after))
        for job in jobs.QUICK if job.outputs for size in (4, 8, 16, 64)]
    harness.case("a disk of 4 to 64 kB", harness.some(runs, 8))


def folders(harness):
    """The output's folder goes, or is shut, while the run goes on.

    Not a batch's: a piece makes the folder anew, while one that is done may
    lose what it had there.
    """
    some_jobs = [job for job in jobs.QUICK if len(job.outputs) == 1]
    gone, moved, shut = [], [], []
    # Nothing is done yet before any of these.
    calls = "write,pwrite,openat,linkat,rename,renameat2,mkdir"
    for job in harness.some(some_jobs, 3):
        for k in range(harness.count_calls(job, calls)):
            at = f"{calls} {k + 1} sh "
            # The hidden name of a folder cannot be removed where it is.
            leaves = job.hidden() if job.makes_folders() else ()
            gone.append((f"{job.name}, {k + 1}", dict(
                job=job, fault=at + "rm -rf out")))
            moved.append((f"{job.name}, {k + 1}", dict(
                job=job, fault=at + "mv out away; : > out",
                leaves=leaves, after=_take_back)))
            shut.append((f"{job.name}, {k + 1}", dict(
                job=job, leaves=leaves, fault=at + "chmod 555 out", prepare=_be_nobody,
                before=lambda place: os.chown(place.file("out"), NOBODY, NOBODY)
                if os.geteuid() == 0 else None)))
    harness.case("the output's folder is removed", harness.some(gone, 6))
    harness.case("a file takes the place of the output's folder",
                 harness.some(moved, 6))
    harness.case("the output's folder is made read-only", harness.some(shut, 6))


def _take_back(place):
    if os.path.isdir(place.file("away")):
        os.unlink(place.file("out"))
        os.rename(place.file("away"), place.file("out"))


def targets(harness):
    """What stands under the output's name is no ordinary file."""
    slc = jobs.named("slc")
    png = jobs.named("png")

    def folder(place):
        os.mkdir(place.file("out/a.slc"))
        write(place.file("out/a.slc/mine"), b"x")

    def foreign(place):
        os.mkdir(place.file("out/a.png"))
        write(place.file("out/a.png/mine"), b"x")

    def keeps(name, wanted):
        def after(place):
            found = contents(place.file(name))
            if found == wanted:
                shutil.rmtree(place.file(name)) if isinstance(found, dict) \
                    else os.unlink(place.file(name))
        return after

    def link(place):
        write(place.file("b.scad"), b"old")
        os.symlink("../b.scad", place.file("out/a.slc"))

    def through(place):
        if os.path.islink(place.file("out/a.slc")):
            os.unlink(place.file("out/a.slc"))
            os.rename(place.file("b.scad"), place.file("out/a.slc"))

    def loop(place):
        os.symlink("a.slc", place.file("out/a.slc"))

    def unlink(place):
        if os.path.islink(place.file("out/a.slc")):
            os.unlink(place.file("out/a.slc"))

    runs = [
        ("a folder", dict(job=slc, before=folder, ends_well=False,
                          after=keeps("out/a.slc", {"mine": b"x"}))),
        ("a foreign folder", dict(job=png, before=foreign, ends_well=False,
                                  after=keeps("out/a.png", {"mine": b"x"}))),
        ("a link", dict(job=slc, before=link, after=through, ends_well=True)),
        ("a link to itself", dict(job=slc, before=loop, after=unlink)),
    ]
    full = jobs.Job("full", "a.scad -q -o /dev/full --export-format slc",
                    "a.scad")
    null = jobs.Job("null", "a.scad -q -o /dev/null --export-format slc",
                    "a.scad")
    runs += [("a full device", dict(job=full, ends_well=False)),
             ("a device", dict(job=null, ends_well=True)),
             ("a FIFO", dict(job=slc, before=_make_fifo, during=_drain,
                             after=_take_drained, ends_well=True))]
    harness.wanted["full"] = harness.wanted["null"] = {"-": b""}
    harness.case("target is a folder, a link, a FIFO, a device", runs)


def _make_fifo(place):
    os.mkfifo(place.file("out/a.slc"))


def _drain(_, place):
    with open(place.file("out/a.slc"), "rb") as file:
        write(place.file("drained"), file.read())


def _take_drained(place):
    if stat.S_ISFIFO(os.stat(place.file("out/a.slc")).st_mode):
        os.rename(place.file("drained"), place.file("out/a.slc"))


# --- Inputs ----------------------------------------------------------------------


def inputs(harness):
    """Inputs change, shrink and fail while they are read."""
    runs = []
    for job in (jobs.named("files"), jobs.named("font")):
        for change in (": > {0}", "rm {0}", "echo more >> {0}",
                       "truncate -s 9 {0}"):
            for name in job.inputs:
                for call in ("read", "fstat", "mmap"):
                    for k in range(harness.count_calls(job, call)):
                        fault = f"{call} {k + 1} sh {change.format(name)}"
                        # It may be another design then: any end is right that
                        # is no crash and writes no half of a file.
                        runs.append((fault, dict(
                            job=job, fault=fault,
                            after=_sound_output(harness, job))))
    if not harness.is_quick and len(runs) > 800:
        runs = harness.random.sample(runs, 800)
    harness.case("inputs change while they are read", harness.some(runs, 10))


def _sound_output(harness, job):
    """Another design's layers are right, too, if `lamina inspect` takes them."""
    def after(place):
        for name in job.outputs:
            if os.path.exists(place.file(name)) and subprocess.run(
                    [harness.lamina, "inspect", place.file(name)],
                    capture_output=True).returncode == 0:
                write(place.file(name), harness.wanted[job.name][name])
    return after


# --- Others write meanwhile ------------------------------------------------------

RENAME_EXCHANGE = 2
AT_FDCWD = -100
_libc = ctypes.CDLL(None, use_errno=True)


def _exchange(one, other):
    """Swaps two names at once, so that none is ever missing."""
    if _libc.renameat2(AT_FDCWD, one.encode(), AT_FDCWD, other.encode(),
                       RENAME_EXCHANGE) != 0:
        raise OSError(ctypes.get_errno(), one)


def _swapping(name, has_link_first, fill):
    """While a run goes on, `name` is in turn what stood there and a link to its
    likeness outside the root, which `fill` makes. It must stay as it was made."""
    def outside(place):
        return place.path + "-outside"

    def paths(place):
        return place.file(name), place.file("tmp.link")

    def before(place):
        os.mkdir(outside(place))
        fill(outside(place))
        os.symlink(os.path.join(outside(place), name), place.file("tmp.link"))
        if has_link_first:
            _exchange(*paths(place))

    def during(process, place):
        while process.poll() is None:
            _exchange(*paths(place))

    def after(place):
        if os.path.islink(place.file(name)):
            _exchange(*paths(place))
        os.unlink(place.file("tmp.link"))
        made = contents(outside(place))
        shutil.rmtree(outside(place))
        os.mkdir(outside(place))
        fill(outside(place))
        if made != contents(outside(place)):
            write(place.file("changed outside"), b"")
        shutil.rmtree(outside(place))

    return dict(before=before, during=during, after=after)


def swaps(harness):
    """Names become links out of the root and back, under --root."""
    job = jobs.named("deep, confined")

    def fill_inputs(folder):
        os.makedirs(os.path.join(folder, "d/e"))
        for name in job.inputs:
            write(os.path.join(folder, name),
                  jobs.OUTSIDE[os.path.basename(name)])

    places = ["d", "d/e"] + job.inputs
    count = 8 * harness.times if harness.is_quick else 2100
    harness.case("inputs become links out of the root and back", [
        (f"{i}: {name}", dict(job=job, **_swapping(name, i % 2, fill_inputs)))
        for i, name in zip(range(count), itertools.cycle(places))])

    def fill_outputs(folder):
        os.mkdir(os.path.join(folder, "out"))
        write(os.path.join(folder, "out/a.slc"), b"mine")

    writing = [jobs.Job(f"{job.name}, confined",
                        " ".join(job.words) + " --root .",
                        " ".join(job.inputs), job.outputs)
               for job in jobs.QUICK  # of .sl1 we warn, and under --root that ends
               if job.outputs and not job.may_warn
               and "--root" not in job.words and job.name != "sl1"]
    count = 16 * harness.times if harness.is_quick else 1400
    harness.case("the output's folder becomes a link out of the root and back", [
        (f"{i}: {job.name}", dict(
            job=job, has_old=i % 4 > 1, leaves=job.hidden(),
            **_swapping("out", i % 2, fill_outputs)))
        for i, job in zip(range(count), itertools.cycle(writing))])


def writers(harness):
    """Two runs make one output at once: it is one's or the other's."""
    pairs = []
    for job in jobs.SLOW:
        other = jobs.Job(job.name + ", other layers",
                         " ".join(job.words) + " --scale 0.9",
                         " ".join(job.inputs), job.outputs)
        harness.learn(other)
        pairs.append((job, other))

    def beside(other, delay):
        def during(_, place):
            time.sleep(delay)
            with open(place.file("tmp.err"), "ab") as errors:
                if subprocess.run(harness.command(other), cwd=place.path,
                                  env=harness.environment(place), stderr=errors,
                                  stdin=subprocess.DEVNULL).returncode != 0:
                    write(place.file("the other one failed"), b"")
        return during

    def either(job, other):
        def after(place):
            for name in job.outputs:
                if contents(place.file(name)) == harness.wanted[other.name][name]:
                    shutil.rmtree(place.file(name), ignore_errors=True)
                    place.write(name, harness.wanted[job.name][name])
        return after

    count = 7 * harness.times if harness.is_quick else 120
    runs = []
    for i, (job, other) in zip(range(count), itertools.cycle(pairs)):
        delay = harness.random.uniform(0, 0.1)
        runs.append((f"{job.name}, after {delay:.3f} s", dict(
            job=job, has_old=i % 2 == 1, during=beside(other, delay),
            after=either(job, other))))
    harness.case("two runs write one output at once", runs)


# --- Streams, surroundings, other programs ---------------------------------------


def streams(harness):
    def closed(*numbers):
        def prepare():
            for number in numbers:
                os.close(number)
        return prepare

    runs = []
    for job in jobs.QUICK:
        for numbers in ((0,), (1,), (2,), (0, 1), (1, 2), (0, 1, 2)):
            ends_well = not (job.prints and 1 in numbers)
            runs.append((f"{job.name}, {numbers} closed", dict(
                job=job, prepare=closed(*numbers), ends_well=ends_well,
                streams={"stdin": None, "close_fds": False})))
    harness.case("standard streams closed", harness.some(runs, 8))

    printing = [job for job in jobs.QUICK if job.prints]
    full = [(job.name, dict(job=job, ends_well=False, streams={
        "stdout": open("/dev/full", "wb")})) for job in printing]
    harness.case("standard output full", full)

    broken = []
    for job in printing:
        reader, writer = os.pipe()
        os.close(reader)
        broken.append((job.name, dict(job=job, ends_well=False,
                                      streams={"stdout": writer})))
    harness.case("nobody reads standard output", broken)


def surroundings(harness):
    text = jobs.named("text")
    runs = []
    for job in harness.some(jobs.QUICK, 4):
        for words, changes in (
                ("no HOME", {"HOME": None}), ("HOME gone", {"HOME": "/no/such"}),
                ("no TMPDIR", {"TMPDIR": None}),
                ("TMPDIR gone", {"TMPDIR": "/no/such"}),
                ("no environment", {name: None for name in os.environ})):
            runs.append((f"{job.name}, {words}",
                         dict(job=job, changes=changes, ends_well=True)))
    harness.case("HOME, TMPDIR or all variables missing",
                 harness.some(runs, 8))
    runs = [(str(changes), dict(job=text, changes=changes,
                                after=_sound_output(harness, text)))
            for changes in ({"FONTCONFIG_FILE": "/no/such"},
                            {"FONTCONFIG_PATH": "/no/such"},
                            {"FONTCONFIG_FILE": "{place}/text.scad"},
                            {"OPENSCAD_FONT_PATH": "/no/such"})]
    harness.case("fonts missing or unreadable", runs)


def other_programs(harness):
    """compare --against openscad where openscad cannot be started."""
    job = jobs.Job("against", "compare a.scad --against openscad", "a.scad")
    harness.wanted["against"] = {"-": b""}
    runs = [("no openscad", dict(job=job, changes={"PATH": "/no/such"},
                                 ends_well=False))]
    for call, error in (("fork", errno.EAGAIN), ("execvp", errno.ENOMEM),
                        ("mkdir", errno.ENOSPC)):
        runs.append((call, dict(job=job, fault=f"{call} 1 errno {error}",
                                ends_well=False)))
    runs.append(("no TMPDIR", dict(job=job, changes={"TMPDIR": "/no/such"},
                                   ends_well=False)))
    harness.case("openscad cannot be started", runs)


ALL = {
    "calls": failing_calls,
    "disk": full_disk,
    "folders": folders,
    "targets": targets,
    "limits": limits,
    "memory": failing_memory,
    "inputs": inputs,
    "swaps": swaps,
    "writers": writers,
    "kills": kills,
    "signals": signals,
    "streams": streams,
    "surroundings": surroundings,
    "programs": other_programs,
}
