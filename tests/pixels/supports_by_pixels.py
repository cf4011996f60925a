#!/usr/bin/env python3
"""Compares the supports that lamina reports with what the printer's pixels show.

    supports_by_pixels.py LAMINA DESIGN… [--tip MM] [--pixel MM] [--layer MM]

support_judge.py judges the images of each design alone and on supports. The laws:

  1. Nothing begins in mid-air, and nothing reaches out farther than a tip holds.
  2. Pixels show as many contacts as lamina reports: one for each support, and
     another one for each that stands on the part.
  3. Supports touch the part nowhere else.
  4. The part is the same with and without supports.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from pixel_stack import PixelStack
from support_judge import Judgement

PANEL = 500  # pixels, on both sides
LEAST = 4  # pixels
SEAMS = 0.01  # share of pixels that a shift by less than a pixel may lose


def lamina(*arguments):
    done = subprocess.run([*map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{arguments}: {done.stderr}")


def judged(given, design, folder):
    """What lamina reports of the supports, and what pixels show."""
    printer = folder / "printer.json"
    printer.write_text(json.dumps({
        "name": "test", "title": "Test", "pixels": [PANEL, PANEL],
        "pixel_mm": [given.pixel] * 2, "right": "+x", "up": "+y"}))
    options = [given.lamina, design, "-q", "--layer", given.layer, "--printer",
               printer]
    report = folder / "report.json"
    lamina(*options, "-o", folder / "part.sl1")
    lamina(*options, f"--supports={given.tip:g}", "--report", report, "-o",
           folder / "supported.sl1")
    stacks = [PixelStack(folder / name, given.pixel)
              for name in ("part.sl1", "supported.sl1")]
    return (json.loads(report.read_text())["supports"],
            Judgement(*stacks, given.tip, LEAST).json())


def faults_of(reported, shown):
    """Sentences about what differs."""
    for kind in ("islands", "unheld", "sides"):
        for place in shown[kind]:
            yield f"{kind}: {place}"
    if reported["unheld"]:
        yield f"lamina reports {reported['unheld']} unheld places"
    ends = reported["count"] + reported["on_part"]
    if len(shown["contacts"]) != ends:
        yield (f"lamina reports {ends} contacts, pixels show"
               f" {len(shown['contacts'])}")
    if shown["stands"] != reported["on_part"]:
        yield (f"lamina reports {reported['on_part']} supports that stand on the"
               f" part, pixels show {shown['stands']}")
    if shown["lost_share"] > SEAMS:
        yield f"{shown['lost_share']:.1%} of the part is missing"


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("lamina")
    options.add_argument("designs", nargs="+")
    options.add_argument("--tip", type=float, default=0.4, help="[mm]")
    options.add_argument("--pixel", type=float, default=0.05, help="[mm]")
    options.add_argument("--layer", type=float, default=0.05, help="[mm]")
    given = options.parse_args()
    failed = False
    for design in given.designs:
        with tempfile.TemporaryDirectory() as folder:
            reported, shown = judged(given, design, pathlib.Path(folder))
        print(f"{design}: {len(shown['contacts'])} contacts of"
              f" {shown['contact_mm2']:.3f} mm², supports of"
              f" {shown['support_mm3']:.1f} mm³")
        for fault in faults_of(reported, shown):
            failed = True
            print(f"{design}: {fault}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
