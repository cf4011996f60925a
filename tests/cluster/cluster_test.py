#!/usr/bin/env python3
"""A table on a real Slurm, while all that can fails.

    tests/cluster/cluster_test.py LAMINA

2,000 orders, twelve of them bad, in 20 tasks on four nodes. A task, a node, the
controller are killed; a node is drained; the disk fills up. Then the same is
submitted again, and all must be as if one run on one machine had made it: each
piece once, none wrong, none lost, the twelve told with row, name and place.

Needs root (for the disk, a tmpfs), and Debian's slurm-wlm and munge.
"""

import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from slurm import Slurm, wait_until

SUBMIT = Path(__file__).resolve().parents[2] / "scripts/cluster/submit"
ROWS, TASKS = 2000, 20
BAD = {17: "30", 118: "fifty", 219: "", 420: "90", 621: "[54]", 822: "-54",
       923: "1e9", 1124: "true", 1325: "0", 1526: "sixty", 1727: "37",
       1928: "81"}

DESIGN = """\
use <band.scad>
size = 54;
engraving = "";
assert(size >= 38 && size <= 80, "no such size");
band(size / PI, 3);
translate([0, size / PI / 2 + 1, 1]) scale(0.2) import("stone.stl");
"""
BAND = """\
module band(d, h) difference() {
  cylinder(d = d + 4, h = h, $fn = 360);
  translate([0, 0, -1]) cylinder(d = d, h = h + 2, $fn = 360);
  for (a = [0 : 6 : 359]) rotate(a) translate([d / 2 + 2, 0, h / 2]) sphere(0.7, $fn = 60);
}
"""
CORNERS = ((0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
STONE = "solid stone\n" + "".join(
    "facet normal 0 0 0\nouter loop\n" + "".join(
        "vertex {} {} {}\n".format(*CORNERS[corner]) for corner in face) +
    "endloop\nendfacet\n" for face in FACES) + "endsolid stone\n"

checks = 0


def check(holds, words):
    global checks
    checks += 1
    if not holds:
        raise SystemExit(f"FAILED: {words}")


def say(words):
    print(f"{time.monotonic() - BEGIN:6.1f} s  {words}", flush=True)


BEGIN = time.monotonic()


def write_orders(folder):
    (folder / "ring.scad").write_text(DESIGN)
    (folder / "band.scad").write_text(BAND)
    (folder / "stone.stl").write_text(STONE)
    draw = random.Random(7)
    rows = ["name,size,engraving"]
    for i in range(1, ROWS + 1):
        name = "../ring" if i == 219 else f"ring-{i}"
        size = BAD.get(i) or f"{draw.uniform(40, 78):.1f}"
        rows.append(f'{name},{size},"No. {i}, {size}"')
    (folder / "orders.csv").write_text("\n".join(rows) + "\n")


def words_of_batch():
    return ["ring.scad", "--table", "orders.csv", "-o",
            "out/{row:/500}/{name}.slc", "--layer", "0.25"]


def outputs(folder):
    return {str(path.relative_to(folder)):
                hashlib.sha256(path.read_bytes()).hexdigest()
            for path in folder.rglob("*") if path.is_file()}


def ledger_lines(folder):
    return sum(path.read_bytes().count(b"\n")
               for path in (folder / "ledgers").glob("*.jsonl"))


def logs_of(folder):
    """What tasks have printed, and their ledgers tell."""
    return "".join(p.read_text(errors="replace")
                   for p in (folder / "ledgers").iterdir())


def without_costs(summary):
    """What must be the same however the pieces were made."""
    return {name: value for name, value in summary.items()
            if name not in ("seconds", "peak_memory_bytes", "torn_lines",
                            "twice")}


def submit(slurm, folder, lamina):
    result = subprocess.run(
        [SUBMIT, "--rows", str(ROWS // TASKS), "--memory", "500M",
         "--lamina", lamina, "--", *words_of_batch()],
        cwd=folder, env=slurm.environment, capture_output=True, text=True,
        check=False)
    check(result.returncode == 0, f"submit: {result.stderr}")


def break_everything(slurm, folder):
    """What can fail does, while the tasks are under way."""
    def wait_for(lines):
        wait_until(lambda: ledger_lines(folder) >= lines, 120,
                   f"{lines} lines in the ledgers")

    wait_for(100)
    os.kill(max(slurm.tasks()), signal.SIGKILL)
    say("killed a task")
    wait_for(300)
    slurm.crash("n2")
    say("killed a node with its task")
    wait_for(400)
    slurm.kill("n4")
    say("killed a slurmd, whose task goes on")
    wait_for(500)
    slurm.kill("slurmctld")
    say("killed the controller")
    wait_for(600)
    slurm.start_controller()
    say("the controller is back")
    wait_until(lambda: slurm.run("scontrol", "ping", check=False).count("UP"),
               60, "the controller")
    slurm.run("scontrol", "update", "nodename=n3", "state=drain",
              "reason=test")
    say("drained a node")


def test_on_slurm(slurm, folder, lamina, single, expected):
    # So small that not all outputs find room.
    room = sum(path.stat().st_size for path in single.rglob("*.slc")) * 6 // 10
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={room}", "lamina-test",
                    folder], check=True)
    try:
        write_orders(folder)
        submit(slurm, folder, lamina)
        say(f"submitted {TASKS} tasks on a disk of {room / 1e6:.1f} MB")
        break_everything(slurm, folder)
        # A controller that was killed may have drained the last node: it knew
        # less than that. Then all nodes are repaired, until the disk is full.
        for _ in range(4):
            slurm.stop_jobs()
            if "No space left on device" in logs_of(folder):
                break
            say("no node is left; all are repaired, and the same submitted")
            slurm.repair_nodes()
            submit(slurm, folder, lamina)
        made = len(outputs(folder / "out"))
        say(f"all jobs have ended; {made} pieces are made")
        check(0 < made < ROWS - len(BAD), "the disk was not full")

        subprocess.run(["mount", "-o", f"remount,size={10 * room}", folder],
                       check=True)
        slurm.repair_nodes()
        before = {p: p.stat().st_mtime_ns for p in folder.rglob("*.slc")}
        submit(slurm, folder, lamina)
        slurm.wait_for_jobs(240)
        say("submitted again, on a larger disk; all jobs have ended")

        made = outputs(folder / "out")
        check(made == outputs(single / "out"),
              "outputs are not those of the single run")
        kept = sum(p.stat().st_mtime_ns == t for p, t in before.items())
        say(f"{len(made)} pieces, byte for byte those of the single run; {kept} "
            "of them from before")
        summary = json.loads((folder / "ledgers/summary.json").read_text())
        check(kept == len(before), f"{len(before) - kept} were made twice")
        check_summary(summary, expected)
    finally:
        subprocess.run(["umount", "-l", folder], check=False)


def check_summary(summary, expected):
    pieces = [p for p in summary["pieces"] if p["status"] != "twice"]
    check(without_costs(dict(summary, pieces=pieces)) ==
          without_costs(expected), f"{summary} is not {expected}")
    check(summary["missing"] == 0, f"{summary['missing']} are missing")
    check([p["row"] for p in pieces] == sorted(BAD), "other rows are bad")
    for piece in pieces:
        name = "../ring" if piece["row"] == 219 else f"ring-{piece['row']}"
        place = f"orders.csv:{piece['row'] + 1}: {name}: "
        check(piece["name"] == name, piece)
        check(piece["messages"] and piece["messages"][0].startswith(place),
              piece)
    say(f"{summary['done']} done, {summary['failed']} told with row, name and "
        f"place, {summary['twice']} made twice, {summary['torn_lines']} torn "
        "lines passed over")


def make_on_one_machine(folder, lamina):
    write_orders(folder)
    words = [lamina, "batch", *words_of_batch()]
    result = subprocess.run([*words, "--ledger", "one.jsonl", "-q"],
                            cwd=folder, capture_output=True, check=False)
    check(result.returncode == 1, result.stderr.decode())
    result = subprocess.run(
        [*words, "--collect", "one.jsonl", "--report", "summary.json"],
        cwd=folder, capture_output=True, text=True, check=False)
    check(result.returncode == 1, result.stderr)
    summary = json.loads((folder / "summary.json").read_text())
    check(summary["done"] == ROWS - len(BAD), summary)
    say("made all on one machine")
    return summary


def main():
    lamina = str(Path(sys.argv[1]).resolve())
    for program in ("munged", "slurmctld", "slurmd", "sbatch"):
        check(shutil.which(program), f"{program} is missing: see "
              "LAMINA_CLUSTER_PACKAGES in scripts/packages.sh")
    check(os.geteuid() == 0, "root is needed")
    with tempfile.TemporaryDirectory(prefix="lamina-cluster-") as name:
        folder = Path(name)
        for part in ("single", "cluster", "slurm"):
            (folder / part).mkdir()
        expected = make_on_one_machine(folder / "single", lamina)
        with Slurm(folder / "slurm", nodes=4) as slurm:
            say("Slurm is up, with four nodes")
            test_on_slurm(slurm, folder / "cluster", lamina, folder / "single",
                          expected)
    say(f"passed: {checks} checks")


if __name__ == "__main__":
    main()
