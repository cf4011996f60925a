"""Plots of the benchmarks as SVG, with nothing but text."""
import math
from dataclasses import dataclass

WIDTH, HEIGHT = 640, 400
LEFT, RIGHT, TOP, BOTTOM = 70, 170, 20, 50
BAR, LABEL = 12, 18  # heights of bars


LAMINA = "#1e8449"  # the colour of lamina's own contours in every plot


@dataclass
class Axis:
    """A logarithmic axis; `ticks` maps values to their labels."""
    low: float
    high: float
    ticks: dict
    title: str

    def share(self, value):
        """0 at the low end, 1 at the high one; what is lower is drawn at 0."""
        low, high = math.log10(self.low), math.log10(self.high)
        return (math.log10(max(value, self.low)) - low) / (high - low)


@dataclass
class Curve:
    """Points of an x and a y each; one point alone is drawn as a cross."""
    points: list
    colour: str
    dash: str = "none"


@dataclass
class Entry:
    """A line of the legend; commas break its label."""
    label: str
    colour: str = "#444"
    dash: str = "none"
    is_point: bool = False


def text(x, y, words, anchor="middle", extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{extra}>'
            f"{words}</text>")


def line(x0, y0, x1, y1, style):
    return (f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" '
            f"{style}/>")


def picture(height, parts):
    yield (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} '
           f'{height}" font-family="sans-serif" font-size="12">')
    yield '<rect width="100%" height="100%" fill="white"/>'
    yield from parts
    yield "</svg>"


def write(path, parts):
    path.write_text("\n".join(parts) + "\n")


def cross(x, y, colour):
    style = f'stroke="{colour}" stroke-width="2"'
    yield line(x - 5, y - 5, x + 5, y + 5, style)
    yield line(x - 5, y + 5, x + 5, y - 5, style)


def legend(entries):
    x, y = WIDTH - RIGHT + 12, TOP + 12
    for entry in entries:
        if entry.is_point:
            yield from cross(x + 11, y - 4, entry.colour)
        else:
            yield line(x, y - 4, x + 22, y - 4, f'stroke="{entry.colour}" '
                       f'stroke-width="2" stroke-dasharray="{entry.dash}"')
        for words in entry.label.split(", "):
            yield text(x + 28, y, words, "start")
            y += 15
        y += 4


def frame(height):
    return (f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" '
            f'height="{height - TOP - BOTTOM}" fill="none" stroke="#888"/>')


def x_of(axis, value):
    return LEFT + axis.share(value) * (WIDTH - LEFT - RIGHT)


def y_of(axis, value):
    return HEIGHT - BOTTOM - axis.share(value) * (HEIGHT - TOP - BOTTOM)


def x_axis(axis, height):
    for value, label in axis.ticks.items():
        x = x_of(axis, value)
        yield line(x, TOP, x, height - BOTTOM, 'stroke="#ddd"')
        yield text(x, height - BOTTOM + 16, label)
    yield text((LEFT + WIDTH - RIGHT) / 2, height - 12, axis.title)


def y_axis(axis):
    for value, label in axis.ticks.items():
        y = y_of(axis, value)
        yield line(LEFT, y, WIDTH - RIGHT, y, 'stroke="#ddd"')
        yield text(LEFT - 6, y + 4, label, "end")
    middle = (TOP + HEIGHT - BOTTOM) / 2
    yield text(16, middle, axis.title,
               extra=f' transform="rotate(-90 16 {middle:.0f})"')


def draw_curve(x, y, curve):
    places = [(x_of(x, a), y_of(y, b)) for a, b in curve.points]
    if len(places) == 1:
        yield from cross(*places[0], curve.colour)
        return
    path = " ".join(f"{a:.1f},{b:.1f}" for a, b in places)
    yield (f'<polyline points="{path}" fill="none" stroke-width="2" '
           f'stroke="{curve.colour}" stroke-dasharray="{curve.dash}"/>')


def curves(x, y, drawn, entries):
    """A plot of `drawn` (Curves) with its legend."""
    def parts():
        yield from x_axis(x, HEIGHT)
        yield from y_axis(y)
        yield frame(HEIGHT)
        for curve in drawn:
            yield from draw_curve(x, y, curve)
        yield from legend(entries)
    return picture(HEIGHT, parts())


def bars(x, groups, entries):
    """Bars from the left end of `x`: groups of a label and of its bars, a value
    and a colour each."""
    height = TOP + BOTTOM + LABEL // 2 + sum(
        LABEL + BAR * len(group) for _, group in groups)

    def parts():
        yield from x_axis(x, height)
        yield frame(height)
        y = TOP
        for label, group in groups:
            y += LABEL
            yield text(LEFT + 4, y - 4, label, "start")
            for value, colour in group:
                yield (f'<rect x="{LEFT}" y="{y}" height="{BAR - 1}" '
                       f'width="{x_of(x, value) - LEFT:.1f}" '
                       f'fill="{colour}"/>')
                y += BAR
        yield from legend(entries)
    return picture(height, parts())
