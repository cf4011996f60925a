#!/usr/bin/env python3
"""Compares what `lamina check` lists with what the printer's pixels show.

    check_by_pixels.py LAMINA DESIGN… [--pixel MM] [--layer MM]

pixel_judge.py judges the images of each design three times:

    printed  pixels that are at least half covered count as solid
    sure     wholly covered ones do: what is solid there is solid in the part
    may      covered ones do: what is empty there is empty in the part

The part lies between `sure` and `may`, so these laws need no tolerance, but for
overhangs, which check looks for at places 0.1 mm apart:

  1. What pixels prove is listed. Pixels of `may` that hang together, at corners
     too, over no pixel of `may` hold an island or the beginning of a loose part.
     Empty pixels in a hollow of what is not sure, open corners included, belong
     to a cup or a trap. A sure pixel whose middle is farther than the reach from
     all that may be solid below hangs over.
  2. What is listed contradicts no pixel. The sure pixels at the place of an
     island lie over no sure one and hang free as long as it says, those of a
     loose part never reach the bed, and the empty ones of a cup or a trap have
     no way out while it is closed. An overhang is no nearer than what may be
     solid below, and no farther than what surely is.
  3. Nothing is listed twice: sure pixels that hang together belong to one island
     or loose part, empty ones to one cup or trap, and no two findings of a kind
     are at one pixel.

Two more are about use:

  4. What is not minor is no sliver: printed pixels show it, or join a part with
     its neighbour where the gap is less than a pixel.
  5. An island of some sure pixels that hangs free in several layers, and a cup of
     more than LEAST_CUP, are not minor.

The table says what the greys leave open: of all findings, and of those that are
not minor, how many pixels prove and how many printed ones show; how many printed
pixels show in LEAST pixels or more, how many of these are not listed, and the
pixels of the greatest of them. What is shown and not listed is joined, or opened,
by less than a pixel: law 1 would report it otherwise.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from pixel_judge import (SLACK, Bodies, Frame, Print, covered, low_bit,
                         parts_of, spread)
from pixel_stack import PixelStack

SOLIDS = ("island", "loose part")
HOLLOWS = ("suction cup", "resin trap")
KINDS = (*SOLIDS, "overhang", *HOLLOWS)
PANEL = 900  # pixels, on both sides
LEAST = 4  # pixels
# Contours of both layers are simplified by 0.001 mm, and a corner may reach into
# a pixel that it leaves black [mm].
ROUNDING = 5e-3
LEAST_CUP = 3.2  # [mm²]
SAMPLING = 0.1  # overhangs are looked for at places so far apart [mm]


def lamina(*arguments):
    done = subprocess.run([*map(str, arguments)], capture_output=True, text=True)
    if done.returncode > 1 or not done.stdout and done.returncode:
        raise SystemExit(f"{arguments}: {done.stderr}")
    return done.stdout


def loops_centroid(loops):
    area = x = y = 0
    for loop in loops:
        for (x0, y0), (x1, y1) in zip(loop, loop[1:] + loop[:1]):
            cross = x0 * y1 - x1 * y0
            area += 3 * cross
            x += (x0 + x1) * cross
            y += (y0 + y1) * cross
    return x / area, y / area


class Trial:
    """A design, what check lists of it, and its pixels."""

    def __init__(self, program, design, given, folder):
        printer = folder / "printer.json"
        printer.write_text(json.dumps({
            "name": "test", "title": "Test", "pixels": [PANEL, PANEL],
            "pixel_mm": [given.pixel] * 2, "right": "+x", "up": "+y"}))
        options = [*design.split(), "--layer", given.layer, "--printer", printer]
        contours = folder / "part.layers.json"
        lamina(program, *options, "-q", "-o", folder / "images.png")
        lamina(program, *options, "-q", "-o", contours)
        self.design = design
        self.findings = json.loads(
            lamina(program, "check", *options, "--json"))["findings"]
        self.stack = PixelStack(folder / "images.png")
        self.pixel = self.stack.pixel
        self.faults = []
        self.shown = []  # (kind, layer, set, is listed), in printed pixels
        self.read(json.loads(contours.read_text())["layers"])
        places = set()
        for finding in self.findings:
            finding["proven"] = finding["shown"] = False
            finding["pixel"] = self.pixel_of(finding)
            finding["box"] = self.box_of(finding)
            place = finding["kind"], finding["layer"], finding["pixel"]
            if place in places:
                self.fault(3, finding, "is listed twice")
            places.add(place)
        self.check_solids([f for f in self.findings if f["kind"] in SOLIDS])
        self.check_hollows([f for f in self.findings if f["kind"] in HOLLOWS])
        self.check_overhangs([f for f in self.findings if f["kind"] == "overhang"])
        for finding in self.findings:
            if not finding["is_minor"] and not finding["shown"] and not (
                    finding["kind"] in SOLIDS and
                    finding["pixel"] & self.printed.layers[finding["layer"]]):
                self.fault(4, finding, "printed pixels do not show it")

    def read(self, layers):
        self.frame = Frame(self.stack)
        self.printed = Print(self.frame, False)
        self.sure = Print(self.frame, False)
        self.may = Print(self.frame, True)
        for number, (_, _, pixels) in enumerate(self.stack.images()):
            if number == self.stack.count // 2:
                self.middle = self.middle_of(layers[number], pixels)
            pixels = self.frame.crop(pixels)
            self.printed.take(covered(pixels, 128))
            self.sure.take(covered(pixels, 255))
            self.may.take(covered(pixels, 1))
        for one in (self.printed, self.sure, self.may):
            one.finish()

    def middle_of(self, layer, pixels):
        """Where the panel's middle is in the design.

        Images do not say it: the centroid of a layer and that of its pixels do.
        """
        whole = sum(pixels)
        x = sum(sum(pixels[i::PANEL]) * (i + 0.5) for i in range(PANEL)) / whole
        y = sum(sum(pixels[i * PANEL:(i + 1) * PANEL]) * (i + 0.5)
                for i in range(PANEL)) / whole
        centroid = loops_centroid([contour["points"]
                                   for contour in layer["contours"]])
        return (centroid[0] - (x - PANEL / 2) * self.pixel,
                centroid[1] + (y - PANEL / 2) * self.pixel)

    def fault(self, law, finding, text):
        place = f"x {finding['x']:.4f} y {finding['y']:.4f}"
        size = ", ".join(f"{key} {finding[key]:.4g}" for key in
                         ("area_mm2", "volume_mm3", "distance_mm") if key in finding)
        self.faults.append(
            f"{self.design}: law {law}: {finding['kind']} in layer "
            f"{finding['layer']} ({finding['first_layer']}-{finding['last_layer']})"
            f" at {place}{', minor' * finding['is_minor']}: {size}: {text}")

    def fault_unlisted(self, kind, layer, piece):
        column, row = self.frame.place_of(low_bit(piece))
        area = piece.bit_count() * self.pixel ** 2
        self.fault(1, {
            "kind": kind, "layer": layer, "first_layer": layer, "last_layer": layer,
            "x": self.middle[0] + (column + 0.5 - PANEL / 2) * self.pixel,
            "y": self.middle[1] - (row + 0.5 - PANEL / 2) * self.pixel,
            "is_minor": False, "area_mm2": area}, "is not listed")

    # --- Places ------------------------------------------------------------------

    def panel_place(self, x, y):
        """Columns and rows from the panel's upper left corner."""
        return (PANEL / 2 + (x - self.middle[0]) / self.pixel,
                PANEL / 2 - (y - self.middle[1]) / self.pixel)

    def pixel_of(self, finding):
        column, row = self.panel_place(finding["x"], finding["y"])
        return self.frame.pixel_at(int(column), int(row))

    def box_of(self, finding):
        """The pixels of a finding's box."""
        margin = SAMPLING if finding["kind"] == "overhang" else 0
        x, y = ((low - margin, high + margin) for low, high in
                zip(finding["low"][:2], finding["high"]))
        left, bottom = self.panel_place(x[0], y[0])
        right, top = self.panel_place(x[1], y[1])
        frame = self.frame
        first = max(int(left) - frame.left, 0)
        last = min(int(right) - frame.left, frame.width - 1)
        line = (1 << last - first + 1) - 1 << first
        box = 0
        for row in range(max(int(top) - frame.top, 0),
                         min(int(bottom) - frame.top, frame.height - 1) + 1):
            box |= line << row * frame.width
        return box

    def distance(self, finding, below):
        """From a finding's place to the nearest of these pixels [mm]."""
        column, row = self.panel_place(finding["x"], finding["y"])
        radius = int(finding["distance_mm"] / self.pixel) + 4
        nearest = math.inf
        for r in range(int(row) - radius, int(row) + radius + 1):
            for c in range(int(column) - radius, int(column) + radius + 1):
                if below & self.frame.pixel_at(c, r):
                    nearest = min(nearest, math.hypot(
                        max(c - column, column - c - 1, 0),
                        max(r - row, row - r - 1, 0)))
        return nearest * self.pixel

    # --- Laws --------------------------------------------------------------------

    def check_solids(self, listed):
        claimed = {}
        for finding in listed:
            layer, pixel = finding["layer"], finding["pixel"]
            if not pixel & self.sure.layers[layer]:
                continue
            begun = next(((piece, body) for at, piece, body in self.sure.solids.begun
                          if at == layer and piece & pixel), None)
            if begun is None:
                self.fault(2, finding, "sure pixels below hold it")
                continue
            piece, body = begun
            if finding["kind"] == "island":
                if body.joined and body.joined <= finding["last_layer"]:
                    self.fault(2, finding, f"is held in layer {body.joined}")
            elif body.root().end:
                self.fault(2, finding, "sure pixels join it to the bed")
            elif body.root().last > finding["last_layer"]:
                self.fault(2, finding, f"goes on to layer {body.root().last}")
            if claimed.setdefault((layer, low_bit(piece)), finding) is not finding:
                self.fault(3, finding, "is listed twice")

        for layer, piece, body in self.may.solids.begun:
            holds = [f for f in listed if f["layer"] == layer and f["pixel"] & piece]
            for finding in holds:
                finding["proven"] = (finding["kind"] == "island" or
                                     body.root().end is None)
            if not holds:
                self.fault_unlisted("island", layer, piece)
            if len(holds) == 1:
                self.check_span(holds[0], body)
            hanging = [at for at, part in body.pieces if
                       (part & self.sure.layers[at]).bit_count() >= LEAST]
            if (holds and body.end != layer + 1 and hanging and
                    all(f["is_minor"] for f in holds)):
                self.fault(5, holds[0], f"hangs in layers {layer} to {hanging[-1]}")
        for body in self.may.loose_parts:
            if not any(f["kind"] == "loose part" and f["layer"] == layer and
                       f["pixel"] & piece for layer, piece in body.pieces
                       for f in listed):
                self.fault_unlisted("loose part", *body.pieces[0])

        for layer, piece, body in self.printed.solids.begun:
            kind = SOLIDS[body.root() is body and body.end is None]
            holds = [f for f in listed if f["box"] & piece and
                     f["first_layer"] <= layer <= f["last_layer"]]
            for finding in holds:
                finding["shown"] = True
            self.shown.append((kind, layer, piece, bool(holds)))

    def check_span(self, finding, body):
        """The only finding in what may be solid hangs free as long as that does."""
        if body.joined and finding["last_layer"] < body.joined - 1:
            self.fault(2, finding, f"hangs free up to layer {body.joined - 1}")
        if not body.joined and finding["last_layer"] > body.root().last:
            self.fault(2, finding, f"ends in layer {body.root().last}")

    def check_hollows(self, listed):
        claimed = {}
        for finding in listed:
            layer, pixel = finding["layer"], finding["pixel"]
            if pixel & self.may.layers[layer]:
                continue
            body = self.may.voids.body_at(layer, pixel)
            if body is None:
                self.fault(2, finding, "empty pixels lead out of it")
                continue
            if body.end and (finding["kind"] == "resin trap" or
                             body.end <= finding["last_layer"]):
                self.fault(2, finding, f"is open in layer {body.end}")
            if finding["kind"] == "resin trap" and not (
                    finding["first_layer"] <= body.first and
                    body.last <= finding["last_layer"]):
                self.fault(2, finding, f"is in layers {body.first} to {body.last}")
            if claimed.setdefault(body.number, finding) is not finding:
                self.fault(3, finding, "is listed twice")

        def holds(layer, piece):
            return [f for f in listed if f["box"] & piece and
                    f["first_layer"] <= layer <= f["last_layer"]]

        for body in self.sure.hollows:
            for layer, piece in body.pieces:
                empty = piece & ~self.may.layers[layer]
                found = holds(layer, empty)
                for finding in found:
                    finding["proven"] = True
                if empty and not found:
                    self.fault_unlisted(HOLLOWS[0], layer, empty)
                    break
                if (found and all(f["is_minor"] for f in found) and
                        empty.bit_count() * self.pixel ** 2 > LEAST_CUP):
                    self.fault(5, found[0], "its pixels have a greater area")
        for body in self.printed.hollows:
            layer, piece = body.widest()
            found = holds(layer, piece)
            for finding in found:
                finding["shown"] = True
            self.shown.append((self.printed.hollow_kind(body), layer, piece,
                               bool(found)))

    def check_overhangs(self, listed):
        for finding in listed:
            below = finding["layer"] - 1
            least = self.distance(finding, self.may.layers[below])
            most = self.distance(finding, self.sure.layers[below])
            if not (least - ROUNDING <= finding["distance_mm"] <= most + ROUNDING):
                self.fault(2, finding, f"it is {least:.4f} to {most:.4f} mm from"
                                       " what is below")
        boxes = [(f, f["box"]) for f in self.findings if f["kind"] not in HOLLOWS]
        hanging, far = Bodies(self.frame, True, 0), [0]
        for layer in range(2, self.stack.count + 1):
            heights = self.stack.heights[layer - 2:layer]
            reach = (sum(heights[1]) - sum(heights[0])) / 2 + SLACK
            proven = self.sure.hanging(layer, self.may, reach, self.pixel)
            shown = self.printed.hanging(layer, self.printed, reach, self.pixel)
            far.append(shown and self.printed.hanging(
                layer, self.printed, reach + math.sqrt(2) * self.pixel, self.pixel))
            hanging.take(self.grown(far[-1]))
            unlisted = proven
            for finding, box in boxes:
                if not finding["first_layer"] <= layer <= finding["last_layer"]:
                    continue
                unlisted &= ~box
                if finding["kind"] == "overhang":
                    finding["shown"] |= bool(box & shown)
                    finding["proven"] |= bool(box & proven)
            for piece in parts_of(unlisted, self.frame.width, True):
                if piece.bit_count() * self.pixel ** 2 > SAMPLING ** 2:
                    self.fault_unlisted("overhang", layer, piece)
        for body in hanging.finish():
            pieces = [(at + 1, piece & far[at]) for at, piece in body.pieces]
            self.shown.append(("overhang", *max(pieces, key=pixels_of), any(
                box & piece and f["first_layer"] <= at <= f["last_layer"]
                for at, piece in pieces for f, box in boxes)))

    def grown(self, bits):
        """So that overhangs no farther from each other than check's are one."""
        for _ in range(round(SAMPLING / self.pixel)):
            bits = spread(bits, self.frame.width, True)
        return bits


def pixels_of(piece):
    return piece[1].bit_count()


def print_table(trial):
    for kind in KINDS:
        listed = [f for f in trial.findings if f["kind"] == kind]
        shown = [entry for entry in trial.shown
                 if entry[0] == kind and entry[2].bit_count() >= LEAST]
        if not listed and not shown:
            continue
        unlisted = [entry[2].bit_count() for entry in shown if not entry[3]]
        matter = [f for f in listed if not f["is_minor"]]
        print(f"{trial.design[-40:]:40} {kind:12}"
              f" {len(listed):6}"
              f" {sum(f['proven'] for f in listed):7}"
              f" {sum(f['shown'] for f in listed):6}"
              f" {len(matter):7}"
              f" {sum(f['proven'] for f in matter):7}"
              f" {sum(f['shown'] for f in matter):6}"
              f" {len(shown):7} {len(unlisted):9} {max(unlisted, default=0):9}")


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("lamina")
    options.add_argument("designs", nargs="+",
                         help="a file, with options of slicing behind it")
    options.add_argument("--pixel", type=float, default=0.035, help="[mm]")
    options.add_argument("--layer", type=float, default=0.05, help="[mm]")
    given = options.parse_args()
    print(f"{'':53} listed  proven  shown  matter  proven  shown  pixels"
          "  unlisted  greatest")
    faults = []
    for design in given.designs:
        with tempfile.TemporaryDirectory() as folder:
            trial = Trial(given.lamina, design, given, pathlib.Path(folder))
        print_table(trial)
        print(*trial.faults, sep="\n", end="\n" * bool(trial.faults), flush=True)
        faults += trial.faults
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
