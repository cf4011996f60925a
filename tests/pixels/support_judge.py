#!/usr/bin/env python3
"""Judges supports by the pixels of two prints: the part alone, and on supports.

    support_judge.py PART SUPPORTED [--tip MM] [--pixel MM] [--least PIXELS]
                                    [--json] [--list]

PART and SUPPORTED are archives or folders of images (pixel_stack.py), of the same
pixels and thickness of layers. It does not matter who made them: whatever is
solid in SUPPORTED and not in PART is a support. The lift is how many layers
SUPPORTED has more, or fewer where that places the part better. The shift in x and
y is that of the topmost layer, where no support is, corrected by a pixel if more of
the part fits. A shift by a fraction of a pixel leaves seams one pixel wide along
the part: after one, pixels beside the part count only near a pixel that is not
beside it.

    contact   pixels of supports that touch the part, beside each other or over
              each other, and hang together over layers. Its area is that of
              columns: support pixels right below the part, or right above it in a
              `stand`, where more columns end above than below
    side      a contact that is larger than three tips in any direction, or that
              no column of it ends at: a pillar or a head that lies along the part
    island    pixels of SUPPORTED that hang together, at corners too, over nothing
              in the layer below
    unheld    pixels of the part that hang together and are farther than eight tips
              and a pixel from all that is solid in the layer below. What hangs
              together over layers is one place; islands do not count again

Groups of fewer than LEAST pixels do not count, neither islands nor contacts nor
unheld places. A pixel is solid if it is at least half covered.
"""
import argparse
import itertools
import json
import math
import sys

from pixel_judge import Frame, covered, flood, low_bit, parts_of, spread
from pixel_stack import PixelStack

HOLD = 8  # a tip holds what is nearer than so many of its diameters
BROAD = 3  # tips; a contact is no larger
SEAM = 2  # pixels beside the part that count near a support
TOP_LAYERS = 5  # that tell the shift
# Layers that supports may stand over the part's top, where they pierce it.
MOST_ABOVE = 12
WELL_PLACED = 0.02  # share of the pixels that may be missing at a place
# Share of the pixels beside the part that supports may be; more are a seam.
WELL_RIMMED = 0.1


# --- Where the part is in the supported print ----------------------------------

class Raster:
    """The sets of solid pixels of images, in the frame of others that are shifted."""

    def __init__(self, frame, shift=(0, 0)):
        self.frame = frame
        self.columns, self.rows = shift

    def of(self, pixels):
        width, height = self.frame.panel
        left, top = self.frame.left - self.columns, self.frame.top - self.rows
        right = left + self.frame.width
        # Beyond the panel all is empty.
        before, behind = bytes(max(-left, 0)), bytes(max(right - width, 0))
        blank = bytes(self.frame.width)
        left, right = max(left, 0), min(right, width)
        return covered(b"".join(
            before + pixels[row * width + left:row * width + right] + behind
            if 0 <= row < height else blank
            for row in range(top, top + self.frame.height)), 128)

    def layers(self, stack):
        return (self.of(pixels) for _, _, pixels in stack.images())


def corner_of(pixels, panel):
    """Column and row of the upper left corner of what is solid, or None."""
    bits = covered(pixels, 128)
    if not bits:
        return None
    width = panel[0]
    line = (1 << width) - 1
    columns = 0
    for row in range(low_bit(bits) // width, bits.bit_length() // width + 1):
        columns |= bits >> row * width & line
    return low_bit(columns), low_bit(bits) // width


def find_place(part, supported, frame):
    """The lift in layers, the shift in columns and rows, and whether it is one by a
    fraction of a pixel: some layers of the part lack pixels there, or have a rim."""
    spots = sorted({part.count * i // 8 for i in range(8)} |
                   set(range(max(part.count - TOP_LAYERS, 0), part.count)))
    ours = [pixels for _, _, pixels in part.images(spots)]
    solid = sum(covered(pixels, 128).bit_count() for pixels in ours)
    if not solid:
        raise ValueError("the part has no pixels to find its place by")
    highest = supported.count - part.count
    best, least = None, math.inf
    for lift in range(highest, max(highest - MOST_ABOVE, 0) - 1, -1):
        theirs = [pixels for _, _, pixels in
                  supported.images([lift + at for at in spots])]
        shift, lost, rim = find_shift(ours, theirs, frame)
        if lost < least:
            best, least = (lift, shift, lost > 0 or rim > WELL_RIMMED), lost
        if lost < WELL_PLACED * solid:
            break
    if best is None:
        raise ValueError("no layer of the part to find its place by")
    return best


def find_shift(ours, theirs, frame):
    """The shift, how many pixels of these layers are missing after it, and what share
    of the pixels beside theirs is solid."""
    for pair in zip(reversed(ours), reversed(theirs)):
        corners = [corner_of(pixels, frame.panel) for pixels in pair]
        if None not in corners:
            break
    else:
        return (0, 0), math.inf, 1
    guess = [b - a for a, b in zip(*corners)]
    whole = Raster(frame)
    aims = [whole.of(pixels) for pixels in theirs]
    near = [(guess[0] + x, guess[1] + y) for x in (0, -1, 1) for y in (0, -1, 1)]

    def moved(shift):
        return map(Raster(frame, shift).of, ours)

    def lost(shift):
        return sum((bits & ~aim).bit_count() for bits, aim in zip(moved(shift), aims))

    shift = min(near, key=lost)
    rims = [spread(bits, frame.width, True) & ~bits for bits in moved(shift)]
    rim = sum((bits & aim).bit_count() for bits, aim in zip(rims, aims))
    return shift, lost(shift), rim / max(sum(bits.bit_count() for bits in rims), 1)


# --- Distances -------------------------------------------------------------------

class Disk:
    """Grows a set by a disk: all whose middle is within the radius of a pixel.

    Takes two shifts for each row of the disk, not one for each of its pixels.
    """

    def __init__(self, radius, frame):
        self.width, self.all = frame.width, frame.all
        self.halves = []  # the disk's half width in the row so far from its middle
        for row in range(int(radius + 0.5) + 1):
            away = max(row - 0.5, 0)
            self.halves.append(int(math.sqrt(radius ** 2 - away ** 2) + 0.5))
        first = sum(1 << row * frame.width for row in range(frame.height))
        last = first << frame.width - 1
        self.may_go_left, self.may_go_right = self.all ^ first, self.all ^ last

    def grown(self, bits):
        rows = [bits]
        for _ in range(max(self.halves)):
            wide = rows[-1]
            rows.append(wide | (wide & self.may_go_right) << 1 |
                        (wide & self.may_go_left) >> 1)
        out = 0
        for row, half in enumerate(self.halves):
            shift = row * self.width
            out |= rows[half] << shift | rows[half] >> shift
        return out & self.all


# --- What hangs together over layers ---------------------------------------------

class Group:
    """Pixels that hang together over layers."""

    def __init__(self):
        self.parent = self
        self.pieces = []  # (layer, set)
        self.below = self.above = self.pixels = 0

    def root(self):
        while self.parent is not self:
            self = self.parent
        return self

    def join(self, other):
        if self is other:
            return
        other.parent = self
        self.pieces += other.pieces
        self.below += other.below
        self.above += other.above
        self.pixels += other.pixels


class Groups:
    """Takes sets of pixels layer by layer; pieces within a pixel are one."""

    def __init__(self, frame):
        self.width = frame.width
        self.all, self.last = [], (0, [])

    def take(self, layer, bits, below=0, above=0):
        before = self.last[1] if self.last[0] == layer - 1 else []
        now = []
        for piece in parts_of(bits, self.width, True):
            group = Group()
            group.pieces.append((layer, piece))
            group.pixels = piece.bit_count()
            group.below = (piece & below).bit_count()
            group.above = (piece & above).bit_count()
            near = spread(piece, self.width, True)
            for other, others_group in before:
                if near & other:
                    group.join(others_group.root())
            self.all.append(group)
            now.append((piece, group))
        self.last = layer, now

    def groups(self):
        return [group for group in self.all if group.parent is group]


def box_of(group, frame):
    """Columns, rows and layers of a group, each (first, last)."""
    columns, rows, layers = set(), set(), set()
    for layer, piece in group.pieces:
        layers.add(layer)
        while piece:
            bit = low_bit(piece)
            piece &= piece - 1
            column, row = frame.place_of(bit)
            columns.add(column)
            rows.add(row)
    return [(min(numbers), max(numbers)) for numbers in (columns, rows, layers)]


# --- The judgement ---------------------------------------------------------------

class Judgement:
    """What the pixels say of the supports.

    lift          layers that are below the part
    shift         of the part, in columns and rows
    lost          share of the part's pixels that the supported print lacks
    part_mm3, support_mm3
    contacts, sides, islands, unheld
                  lists of dictionaries; a contact that is a side is in both
    """

    def __init__(self, part, supported, tip, least):
        if abs(part.pixel - supported.pixel) > 1e-6 * part.pixel:
            raise ValueError("the prints have different pixels")
        self.pixel = part.pixel
        self.rise = supported.heights[0][1] - supported.heights[0][0]
        if abs(part.heights[0][1] - part.heights[0][0] - self.rise) > 1e-6:
            raise ValueError("the prints have layers of different thickness")
        if supported.count < part.count:
            raise ValueError("the supported print is lower than the part")
        self.tip, self.least = tip, least
        self.frame = frame = Frame(supported)
        if [size[:2] for size in part.images([0])] != [frame.panel]:
            raise ValueError("the prints are for different panels")
        self.lift, self.shift, self.has_seams = find_place(part, supported, frame)
        self.disk = Disk(HOLD * tip / self.pixel + 1, frame)
        self.touches, self.hanging = Groups(frame), Groups(frame)
        self.islands = []
        self.solid_pixels = self.support_pixels = self.lost_pixels = 0
        above = supported.count - part.count - self.lift
        self.read(itertools.chain(
            itertools.repeat(0, self.lift),
            Raster(frame, self.shift).layers(part), itertools.repeat(0, above)),
            Raster(frame).layers(supported))
        self.list_contacts()
        self.unheld = [self.place(*max(group.pieces, key=pixels_of))
                       for group in self.hanging.groups()
                       if group.pixels >= self.least]

    def read(self, part, supported):
        """Looks at each support layer between its neighbours of the part."""
        below_part = below_all = support = under = 0
        for layer, (solid, whole) in enumerate(zip(part, supported), 1):
            self.take_touches(layer - 1, support, below_part, solid, under)
            self.solid_pixels += solid.bit_count()
            self.lost_pixels += (solid & ~whole).bit_count()
            under = below_part
            below_part = solid
            support = self.support_of(solid, whole)
            self.support_pixels += support.bit_count()
            if layer > 1:
                self.judge_hold(layer, solid & whole, solid | support, below_all)
            below_all = solid & whole | support
        self.take_touches(layer, support, below_part, 0, under)

    def support_of(self, solid, whole):
        """The supports in a layer, without the seams of a shift by less than a
        pixel."""
        rest = whole & ~solid
        if not self.has_seams:
            return rest
        core = rest & ~spread(solid, self.frame.width, True)
        for _ in range(SEAM):
            core = spread(core, self.frame.width, True) & rest
        return core

    def take_touches(self, layer, support, beside, over, under):
        """Takes the pixels of a support's layer that touch the part's three."""
        if not support:
            return
        below, above = support & over, support & under
        self.touches.take(
            layer, below | above |
            support & spread(beside, self.frame.width, False), below, above)

    def judge_hold(self, layer, solid, whole, below):
        held = flood(below, whole, self.frame.width, True)
        for piece in parts_of(whole & ~held, self.frame.width, True):
            if piece.bit_count() >= self.least:
                self.islands.append(self.place(layer, piece))
        free = solid & held & ~below
        for _ in range(2):  # most layers hang over no farther
            free &= ~spread(below, self.frame.width, True)
        if free:
            free &= ~self.disk.grown(below)
        if free:
            self.hanging.take(layer, free)

    def list_contacts(self):
        self.contacts, self.sides = [], []
        for group in self.touches.groups():
            if group.pixels < self.least:
                continue
            box = box_of(group, self.frame)
            contact = self.place(*max(group.pieces, key=pixels_of))
            contact["layers"] = list(box[2])
            contact["size_mm"] = [
                round((last - first + 1) * step, 4) for (first, last), step in
                zip(box, (self.pixel, self.pixel, self.rise))]
            contact["is_stand"] = group.above > group.below
            contact["area_mm2"] = (max(group.above, group.below) *
                                   self.pixel ** 2)
            if not group.above | group.below or (
                    max(contact["size_mm"]) > BROAD * self.tip):
                self.sides.append(contact)
            self.contacts.append(contact)

    def place(self, layer, piece):
        """Where a piece is; its layer is that of the supported print, from 1."""
        column, row = self.frame.place_of(low_bit(piece))
        return {"layer": layer, "column": column, "row": row,
                "pixels": piece.bit_count()}

    @property
    def stands(self):
        return [contact for contact in self.contacts if contact["is_stand"]]

    def area(self):
        """Of all contacts [mm²]."""
        return sum(contact["area_mm2"] for contact in self.contacts)

    def volume(self, pixels):
        return pixels * self.pixel ** 2 * self.rise

    def json(self):
        return {
            "pixel_mm": self.pixel, "layer_mm": self.rise, "tip_mm": self.tip,
            "least_pixels": self.least, "lift_layers": self.lift,
            "shift_pixels": list(self.shift),
            "lost_share": self.lost_pixels / max(self.solid_pixels, 1),
            "part_mm3": self.volume(self.solid_pixels),
            "support_mm3": self.volume(self.support_pixels),
            "contact_mm2": self.area(),
            "stands": len(self.stands), "contacts": self.contacts,
            "sides": self.sides, "islands": self.islands, "unheld": self.unheld}


def pixels_of(piece):
    return piece[1].bit_count()


def text_of(judged):
    lines = [
        f"part      {judged['part_mm3']:.2f} mm³",
        f"supports  {judged['support_mm3']:.2f} mm³",
        f"contacts  {len(judged['contacts'])} of {judged['contact_mm2']:.3f} mm²,"
        f" {judged['stands']} of them stand on the part",
        f"sides     {len(judged['sides'])} contacts larger than"
        f" {BROAD * judged['tip_mm']:g} mm",
        f"islands   {len(judged['islands'])}",
        f"unheld    {len(judged['unheld'])} places farther than"
        f" {HOLD * judged['tip_mm']:g} mm from what is below",
        f"not counted: what has fewer than {judged['least_pixels']} pixels of"
        f" {judged['pixel_mm']:g} mm",
        f"the part is {judged['lift_layers']} layers higher, shifted by"
        " {} columns and {} rows".format(*judged["shift_pixels"]) +
        f"; {judged['lost_share']:.2%} of its pixels are missing"]
    return "\n".join(lines)


def list_of(judged):
    for kind in ("contacts", "sides", "islands", "unheld"):
        for place in judged[kind]:
            size = place.get("size_mm")
            yield (f"{kind:9} layer {place['layer']:5}  column"
                   f" {place['column']:5}  row {place['row']:5}"
                   f" {place['pixels']:7} pixels" +
                   ("  {:g} x {:g} x {:g} mm".format(*size) if size else ""))


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("part")
    options.add_argument("supported")
    options.add_argument("--tip", type=float, default=0.4,
                         help="its diameter [mm]")
    options.add_argument("--pixel", type=float, help="its side [mm]")
    options.add_argument("--least", type=int, default=4,
                         help="groups of fewer pixels do not count")
    options.add_argument("--json", action="store_true")
    options.add_argument("--list", action="store_true",
                         help="where each contact, island and unheld place is")
    given = options.parse_args()
    judged = Judgement(PixelStack(given.part, given.pixel),
                       PixelStack(given.supported, given.pixel), given.tip,
                       given.least).json()
    if given.json:
        print(json.dumps(judged, indent=1))
        return 0
    print(text_of(judged))
    if given.list:
        print(*list_of(judged), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
