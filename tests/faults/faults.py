"""Breaks the world around lamina in every way we know and prints a table.

    faults.py LAMINA SHIM [--quick [--times N]] [--only KIND]... [--jobs N]

LAMINA is the program, SHIM the library of fault_shim.cpp. Ends with 1 if a run
broke the rule (harness.py), with 77 if a kind that --only names could not be run
on this machine. --quick tries a few of the places where each fault
can strike, by --seed others.
"""

import argparse
import os
import sys

import cases
from harness import Harness

NOT_RUN = 77  # what ctest is told, by tests/faults/CMakeLists.txt


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lamina")
    parser.add_argument("shim")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--times", type=int, default=1,
                        help="a quick look so many times as large")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append", choices=cases.ALL)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    harness = Harness(arguments.lamina, arguments.shim, arguments.quick,
                      arguments.times, arguments.jobs, arguments.seed)
    print(f"{'fault':<64}{'runs':>7}  outcome")
    try:
        for kind in arguments.only or cases.ALL:
            cases.ALL[kind](harness)
    finally:
        harness.close()
    print(f"{len(harness.broken)} broken, {len(harness.left_out)} not run")
    if harness.broken:
        return 1
    return NOT_RUN if harness.left_out and arguments.only else 0


if __name__ == "__main__":
    sys.exit(main())
