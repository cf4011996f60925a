"""lamina for Python: from an OpenSCAD design to its layers.

    import lamina

    ring = lamina.Design("solitaire.scad").with_(carat=0.75)
    for layer in ring.slice(layer=0.05):
        print(layer.z, layer.area, [len(loop) for loop in layer.loops])

Lengths are millimetres. Faults are raised as lamina.Error; nothing is printed.
Long calls let other threads of Python run. docs/python.md says more.
"""

from __future__ import annotations

import html
import json
import os
from typing import Any, Mapping, Sequence, Union

from . import _lamina, _values
from ._lamina import Layer, version
from ._records import (
    Call,
    Error,
    Finding,
    Inspection,
    Parameter,
    Row,
    Support,
    ThinPlace,
    Value,
)

__all__ = [
    "Call",
    "Design",
    "Error",
    "Finding",
    "Inspection",
    "Layer",
    "Page",
    "Parameter",
    "Row",
    "Support",
    "ThinPlace",
    "Value",
    "inspect",
    "version",
]

Path = Union[str, "os.PathLike[str]"]


class Design:
    """A solid, read once, to be sliced as often as needed, also by several
    threads at a time."""

    def __init__(
        self,
        path: Path,
        *,
        text: str | None = None,
        values: Mapping[str, Value] | None = None,
        definitions: Sequence[str] = (),
        parameter_file: Path = "",
        parameter_set: str = "",
        chordal_error: float = 0,
        scale: float = 1,
        axis: str = "z",
        place_on_bed: bool = False,
        supports: bool | float | str = False,
        raft: bool = False,
        sprue: bool = False,
        hollow: float = 0,
        layer: float = 0.05,
        printer: str = "",
        material: str = "",
        metal: str = "",
        prices: Sequence[str] = (),
        language: str = "auto",
        seed: int = 0,
        max_depth: int = 300000,
        max_leaves: int = 10000000,
        root: Path = "",
        readable: Sequence[Path] = (),
        no_import: bool = False,
    ) -> None:
        """Reads a .scad or .csg file.

        The options are those of the program (docs/usage.md), and:

        text      the design itself; `path` is only its name then
        values    of its parameters; what its customizer does not offer is an
                  error
        supports  True, "light", "medium", "heavy", or the diameter of tips
        layer     that supports, drains and sprues are made for
        """
        self._solid = _lamina.Solid(
            os.fspath(path),
            text,
            {
                "values": _values.set_of(values or {}),
                "definitions": list(definitions),
                "parameter_file": os.fspath(parameter_file),
                "parameter_set": parameter_set,
                "chordal_error": chordal_error,
                "scale": scale,
                "axis": axis,
                "place_on_bed": place_on_bed,
                "supports": _size_of(supports),
                "raft": raft,
                "sprue": sprue,
                "hollow": hollow,
                "layer": layer,
                "printer": printer,
                "material": material,
                "metal": metal,
                "prices": list(prices),
                "language": language,
                "seed": seed,
                "max_depth": max_depth,
                "max_leaves": max_leaves,
                "root": os.fspath(root),
                "readable": [os.fspath(folder) for folder in readable],
                "no_import": no_import,
                "module_folder": os.path.dirname(os.path.abspath(__file__)),
            },
        )

    @classmethod
    def from_text(
        cls, text: str, *, name: Path = "design.scad", **options: Any
    ) -> Design:
        """The design in a text, which finds its files as if it stood in the file
        `name`; options as of Design."""
        return cls(name, text=text, **options)

    def with_(self, **values: Value) -> Design:
        """The design with other values of its parameters, read anew."""
        design = object.__new__(type(self))
        design._solid = self._solid.with_values(_values.set_of(values))
        return design

    @property
    def parameters(self) -> list[Parameter]:
        """What the customizer offers, in the order of the design."""
        return [_values.parameter_of(*row) for row in self._solid.parameters()]

    @property
    def supports(self) -> list[Support]:
        """The supports that were added."""
        return [Support(*row) for row in self._solid.supports()]

    @property
    def messages(self) -> list[str]:
        """What the design echoed and was warned of, as the program prints it."""
        return self._solid.messages()

    def slice(
        self,
        layer: float = 0.05,
        *,
        adaptive: float = 0,
        max_layer: float = 0,
        heights: Sequence[float] = (),
        tolerance: float = 0.001,
        compensation: float = 0,
        threads: int = 0,
    ) -> list[Layer]:
        """All layers, the lowest first; options as of the program."""
        return self._solid.slice(
            _options(
                layer, compensation, threads, adaptive, max_layer, heights, tolerance
            )
        )

    def write(
        self,
        path: Path,
        layer: float = 0.05,
        *,
        adaptive: float = 0,
        max_layer: float = 0,
        heights: Sequence[float] = (),
        tolerance: float = 0.001,
        compensation: float = 0,
        threads: int = 0,
        printer: str = "",
        mirror: str = "",
    ) -> None:
        """Writes the layers into a file, in the format of its extension.

        printer  whose panel images are for
        mirror   "x", "y" or "xy": images are turned over
        """
        options = _options(
            layer, compensation, threads, adaptive, max_layer, heights, tolerance
        )
        self._solid.write(os.fspath(path), options, printer, mirror)

    def check(
        self,
        layer: float = 0.05,
        *,
        self_supporting: float = 0,
        compensation: float = 0,
        threads: int = 0,
    ) -> list[Finding]:
        """What would go wrong in the print, from the bottom to the top."""
        found = self._solid.check(
            _options(layer, compensation, threads), self_supporting
        )
        return [Finding(*row) for row in found]

    def thin_places(
        self,
        width: float,
        layer: float = 0.05,
        *,
        compensation: float = 0,
        threads: int = 0,
    ) -> list[ThinPlace]:
        """Walls and gaps thinner than `width`, from the bottom to the top."""
        found = self._solid.thin_places(width, _options(layer, compensation, threads))
        return [ThinPlace(*row) for row in found]

    def report(
        self,
        layer: float = 0.05,
        *,
        min_feature: float = 0,
        self_supporting: float = 0,
        compensation: float = 0,
        threads: int = 0,
    ) -> dict[str, Any]:
        """What the piece weighs, costs and takes: a quote of docs/serve.md."""
        options = _options(layer, compensation, threads)
        report: dict[str, Any] = json.loads(
            self._solid.report(options, self_supporting, min_feature)
        )
        return report

    def page(self, layer: float = 0.05, *, threads: int = 0) -> Page:
        """A page that shows layers and solid; Jupyter shows it in a cell."""
        return Page(self._solid.page(_options(layer, 0, threads)))


class Page:
    """A page of HTML, which needs no other file and no network."""

    def __init__(self, html: str, height: int = 600) -> None:
        self.html = html
        self.height = height  #: of the frame in Jupyter [pixels]

    def _repr_html_(self) -> str:
        return (
            f'<iframe style="width:100%;height:{self.height}px;border:0" '
            f'sandbox="allow-scripts" srcdoc="{html.escape(self.html)}"></iframe>'
        )


def inspect(
    path: Path, *, min_feature: float = 0, self_supporting: float = 0
) -> Inspection:
    """What a file of layers holds, and what is wrong with it."""
    format, writer, rows, volume, defects, reported, thin, found = _lamina.inspect(
        os.fspath(path), self_supporting, min_feature
    )
    return Inspection(
        format,
        writer,
        [Row(*row) for row in rows],
        volume,
        defects,
        reported,
        [ThinPlace(*row) for row in thin],
        [Finding(*row) for row in found],
    )


def _options(
    layer: float,
    compensation: float,
    threads: int,
    adaptive: float = 0,
    max_layer: float = 0,
    heights: Sequence[float] = (),
    tolerance: float = 0.001,
) -> _lamina.SliceOptions:
    return _lamina.SliceOptions(
        layer, adaptive, max_layer, list(heights), tolerance, compensation, threads
    )


def _size_of(supports: bool | float | str) -> str:
    if isinstance(supports, str):
        return supports
    if isinstance(supports, bool):
        return "auto" if supports else ""
    return repr(float(supports))
