#!/usr/bin/env python3
"""Judges a print by its pixels: what hangs in mid-air, what closes liquid in.

    pixel_judge.py STACK [--pixel MM] [--least PIXELS]

STACK is an archive (.sl1, .zip), a .goo file or a folder of images. Counts are
those of what a panel without greys would cure: pixels at least half covered.

A set of pixels is one Python integer: bit row · width + column, rows from the top.
A set grows by a pixel all round with four shifts, so a layer floods in a few
milliseconds, without any library.

The words are those of slicer/check/print/layer_graph.h, over pixels:

    island       solid pixels that hang together in a layer, none of them over a
                 solid one of the layer before
    loose part   solid pixels that hang together over layers and never reach the
                 first one
    cup, trap    empty pixels that hang together, from which no way leads out
                 through the layers built so far; a trap is never opened. The
                 plate closes what is open below the first layer
    overhang     solid pixels of what is no island whose middle is farther than
                 `reach` from every solid pixel of the layer before
"""
import argparse
import collections
import math
import sys

from pixel_stack import PixelStack

MARGIN = 2  # of empty pixels round all that is ever covered
SLACK = 0.0015  # a surface of 45° does not hang over [mm]


# --- Sets of pixels ------------------------------------------------------------

class Frame:
    """The part of the images that holds all that is covered, and a margin."""

    def __init__(self, stack):
        rows, columns = set(), 0
        for width, height, pixels in stack.images():
            blank = bytes(width)
            for row in range(height):
                line = pixels[row * width:(row + 1) * width]
                if line != blank:
                    rows.add(row)
                    columns |= int.from_bytes(line, "little")
        self.panel = width, height
        bits = [i // 8 for i in (low_bit(columns), columns.bit_length() - 1)]
        self.left, right = bits[0] - MARGIN, bits[1] + MARGIN
        self.top, bottom = min(rows) - MARGIN, max(rows) + MARGIN
        if self.left < 0 or self.top < 0 or right >= width or bottom >= height:
            raise ValueError("the part reaches the rim of the panel")
        self.width, self.height = right - self.left + 1, bottom - self.top + 1
        row = (1 << self.width) - 1
        sides = 1 | 1 << self.width - 1
        self.all = (1 << self.width * self.height) - 1
        self.rim = row | row << self.width * (self.height - 1)
        for i in range(self.height):
            self.rim |= sides << self.width * i

    def crop(self, pixels):
        width = self.panel[0]
        first = self.top * width + self.left
        return b"".join(pixels[at:at + self.width] for at in
                        range(first, first + self.height * width, width))

    def pixel_at(self, column, row):
        """The set of one pixel of the panel; empty outside of the frame."""
        column, row = column - self.left, row - self.top
        if 0 <= column < self.width and 0 <= row < self.height:
            return 1 << row * self.width + column
        return 0

    def place_of(self, bit):
        """Column and row on the panel."""
        return bit % self.width + self.left, bit // self.width + self.top


def low_bit(bits):
    return (bits & -bits).bit_length() - 1


def covered(pixels, least):
    """The set of the pixels whose grey is at least that."""
    table = bytes([48] * least + [49] * (256 - least))
    return int(pixels[::-1].translate(table), 2)


def spread(bits, width, corners):
    """Grown by a pixel: towards four neighbours, or eight."""
    row = bits | bits << 1 | bits >> 1
    column = row if corners else bits
    return row | column << width | column >> width


def flood(seed, mask, width, corners):
    """All of `mask` that hangs together with the seed."""
    bits = seed & mask
    rounds = 0
    while True:
        grown = spread(bits, width, corners) & mask
        if grown == bits:
            return bits
        bits = grown
        rounds += 1
        if rounds > 12:  # a long way: along rows and columns at once
            for step, length in ((1, width), (width, mask.bit_length() // width)):
                up, down, reach, shift = mask, mask, 1, step
                while reach <= length:
                    bits |= up & bits << shift
                    bits |= down & bits >> shift
                    up &= up << shift
                    down &= down >> shift
                    reach, shift = 2 * reach, 2 * shift


def parts_of(bits, width, corners):
    """The sets of pixels that hang together."""
    while bits:
        first = low_bit(bits) // width * width  # the part has no row above
        rows = 16
        while True:
            window = bits >> first & (1 << rows * width) - 1
            part = flood(window & -window, window, width, corners)
            if part.bit_length() <= (rows - 1) * width or rows * width > (
                    bits.bit_length() - first):
                break
            rows *= 4
        part <<= first
        bits ^= part
        yield part


# --- What hangs together over layers -------------------------------------------

class Body:
    """Pixels that hang together and are not anchored in the layers so far."""

    def __init__(self, number):
        self.parent = self
        self.number = number
        self.pieces = []  # (layer, set)
        self.end = None  # the first layer that anchors it
        self.joined = None  # that anchors it or makes it part of an older one
        self.on_plate = False

    def root(self):
        body = self
        while body.parent is not body:
            body = body.parent
        return body

    first = property(lambda self: min(layer for layer, _ in self.pieces))
    last = property(lambda self: max(layer for layer, _ in self.pieces))
    pixels = property(lambda self: sum(bits.bit_count() for _, bits in self.pieces))

    def widest(self):
        """The layer with the greatest piece, and that piece."""
        return max(self.pieces, key=lambda piece: piece[1].bit_count())


class Bodies:
    """Solids, anchored to the first layer, or voids, anchored to the rim.

    What is anchored in a layer is known as a whole, by flooding from what is
    anchored in the one before; only the rest is taken apart.
    """

    def __init__(self, frame, corners, anchor):
        self.width, self.corners = frame.width, corners
        self.anchor = anchor  # of each layer: a set, or "first"
        self.layer = 0
        self.anchored = 0
        self.loose = []  # (set, body) of the last layer
        self.bodies = []
        self.begun = []  # (layer, set, body): pieces over nothing

    def take(self, bits):
        self.layer += 1
        if self.anchor == "first":
            seed = bits if self.layer == 1 else self.anchored
        else:
            seed = self.anchored | self.anchor
        anchored = flood(seed, bits, self.width, self.corners)
        before = self.loose
        self.loose = []
        for piece in parts_of(bits & ~anchored, self.width, self.corners):
            below = {id(b.root()): b.root() for s, b in before if s & piece}
            body, *others = below.values() or [Body(len(self.bodies))]
            for other in others:
                body = self.join(body, other)
            if not below:
                self.bodies.append(body)
                self.begun.append((self.layer, piece, body))
                body.on_plate = self.layer == 1
            self.loose.append((piece, body))
        for piece, body in before:
            if piece & anchored:
                self.end(body.root())
        # A piece of an anchored body is anchored too.
        kept = []
        for piece, body in self.loose:
            body = body.root()
            if body.end is None:
                body.pieces.append((self.layer, piece))
                kept.append((piece, body))
            else:
                anchored |= piece
        self.loose = kept
        self.anchored = anchored

    def join(self, a, b):
        kept, other = (a, b) if a.number < b.number else (b, a)
        other.parent = kept
        other.joined = self.layer
        kept.pieces += other.pieces
        kept.on_plate |= other.on_plate
        other.pieces = []
        return kept

    def end(self, body):
        if body.end is None:
            body.end = body.joined = self.layer

    def body_at(self, layer, pixel):
        for body in self.bodies:
            if any(at == layer and piece & pixel for at, piece in body.pieces):
                return body
        return None

    def finish(self):
        """Above the last layer all is open."""
        if self.anchor != "first":
            self.layer += 1
            for _, body in self.loose:
                self.end(body.root())
        return [body for body in self.bodies
                if body.parent is body and body.pieces]


# --- A print -------------------------------------------------------------------

def reachable(bits, width, reach, pixel):
    """What has its middle within reach of one of the pixels."""
    out = 0
    steps = int(reach / pixel + 0.5)
    for dy in range(-steps, steps + 1):
        for dx in range(-steps, steps + 1):
            if math.hypot(max(abs(dx) - 0.5, 0), max(abs(dy) - 0.5, 0)) * pixel <= reach:
                shift = dy * width + dx
                out |= bits << shift if shift >= 0 else bits >> -shift
    return out


class Print:
    """What a stack of sets of pixels does when it is built.

    corners  whether solid pixels that touch in a corner hang together; empty ones
             do if solid ones do not
    """

    def __init__(self, frame, corners):
        self.frame, self.corners = frame, corners
        self.layers = [0]  # solid sets, from 1
        self.solids = Bodies(frame, corners, "first")
        self.voids = Bodies(frame, not corners, frame.rim)

    def take(self, solid):
        self.layers.append(solid)
        self.solids.take(solid)
        self.voids.take(self.frame.all & ~solid)

    def finish(self):
        self.loose_parts = [b for b in self.solids.finish() if b.end is None]
        self.hollows = self.voids.finish()

    def islands(self):
        """(layer, set) of each; a loose part is not an island besides."""
        return [(layer, piece) for layer, piece, body in self.solids.begun
                if not (body.root() is body and body.end is None)]

    def hollow_kind(self, body):
        return "resin trap" if body.end is None and not body.on_plate else "suction cup"

    def hanging(self, layer, below, reach, pixel):
        """What of a layer hangs over the one before of the print `below`."""
        hanging = self.layers[layer] & ~reachable(
            below.layers[layer - 1], self.frame.width, reach, pixel)
        for at, piece, _ in self.solids.begun:
            if at == layer:
                hanging &= ~piece
        return hanging


def judge(stack, levels=((128, False),)):
    """Frame and prints of the pixels with at least these greys."""
    frame = Frame(stack)
    prints = [Print(frame, corners) for _, corners in levels]
    for _, _, pixels in stack.images():
        pixels = frame.crop(pixels)
        for one, (least, _) in zip(prints, levels):
            one.take(covered(pixels, least))
    for one in prints:
        one.finish()
    return frame, prints


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("stack")
    options.add_argument("--pixel", type=float, help="its side [mm]")
    options.add_argument("--least", type=int, default=4,
                         help="leave out what has fewer pixels in its widest layer")
    given = options.parse_args()
    stack = PixelStack(given.stack, given.pixel)
    frame, (printed,) = judge(stack)
    found = [("island", layer, piece, piece.bit_count())
             for layer, piece in printed.islands()]
    for body in printed.loose_parts:
        found.append(("loose part", *body.widest(), body.pixels))
    for body in printed.hollows:
        found.append((printed.hollow_kind(body), *body.widest(), body.pixels))
    for layer in range(2, stack.count + 1):
        rise = (sum(stack.heights[layer - 1]) - sum(stack.heights[layer - 2])) / 2
        hanging = printed.hanging(layer, printed, rise + SLACK, stack.pixel)
        for piece in parts_of(hanging, frame.width, True):
            found.append(("overhang", layer, piece, piece.bit_count()))
    counts = collections.Counter()
    for kind, layer, piece, pixels in sorted(found, key=lambda f: f[:2]):
        if piece.bit_count() < given.least:
            continue
        counts[kind] += 1
        if kind != "overhang":
            column, row = frame.place_of(low_bit(piece))
            print(f"{kind:12} layer {layer:5}  column {column:5}  row {row:5}"
                  f" {pixels:9} pixels")
    print(dict(counts))


if __name__ == "__main__":
    sys.exit(main())
