"""What lamina's functions return, and what they raise."""

from __future__ import annotations

from typing import NamedTuple, Sequence, Union

#: What a parameter of a design can be.
Value = Union[bool, float, str, Sequence["Value"]]


class Call(NamedTuple):
    """A call that led to an error, and where it stands."""

    message: str  #: "called from module 'prong'"
    file: str
    line: int
    column: int


class Error(Exception):
    """A fault of a design, of a file or of options.

    Its text is what the program prints: place, line and carets.
    """

    message: str  #: the first error's, without a place
    file: str  #: empty where no place is known
    line: int  #: from 1
    column: int  #: from 1, in bytes
    calls: list[Call]  #: that led to it, the innermost first

    def __init__(
        self,
        text: str,
        fault: tuple[str, str, int, int] | None = None,
        calls: Sequence[tuple[str, str, int, int]] = (),
    ) -> None:
        super().__init__(text, fault, calls)
        self.message, self.file, self.line, self.column = fault or (text, "", 0, 0)
        self.calls = [Call(*call) for call in calls]

    def __str__(self) -> str:
        return str(self.args[0]).rstrip("\n")


class Parameter(NamedTuple):
    """A value of the design that its customizer lets users choose."""

    name: str
    value: Value
    choices: tuple[Value, ...]  #: empty: any, within the limits
    minimum: float | None
    maximum: float | None
    step: float | None
    description: str
    group: str


class ThinPlace(NamedTuple):
    """A wall or gap that is too thin; lengths in mm."""

    kind: str  #: "wall" or "gap"
    width: float
    x: float
    y: float
    z: float
    bottom: float
    top: float
    source: str  #: the lines of the design that made it


class Finding(NamedTuple):
    """What would go wrong in the print; in mm, mm² and mm³."""

    #: "island", "loose part", "overhang", "suction cup" or "resin trap"
    kind: str
    is_minor: bool
    first_layer: int  #: from 1
    last_layer: int
    bottom: float
    top: float
    x: float
    y: float
    z: float
    area: float
    volume: float
    distance: float
    source: str  #: the line of the design that made it


class Support(NamedTuple):
    """A support that was added; in mm."""

    x: float  #: of the middle of its tip
    y: float
    z: float
    tip: float  #: its diameter there
    is_on_bed: bool
    source: str  #: the line of what it holds


class Row(NamedTuple):
    """A layer as `lamina inspect` lists it; in mm and mm²."""

    bottom: float
    thickness: float
    loops: int
    holes: int
    vertices: int
    area: float
    perimeter: float


class Inspection(NamedTuple):
    """What a file of layers holds, and what is wrong with it."""

    format: str
    writer: str  #: empty where it is not known
    layers: list[Row]
    volume: float  #: [mm³]
    defects: int
    reported_defects: list[str]
    thin_places: list[ThinPlace]
    findings: list[Finding]
