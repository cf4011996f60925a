# The extension module (api/python/module.cpp).
from typing import Any

import numpy
import numpy.typing

version: str

class Layer:
    """A layer; `loops` share its memory and keep it alive."""

    @property
    def z(self) -> float:
        """height of the section [mm]"""
    @property
    def bottom(self) -> float:
        """its lower side [mm]"""
    @property
    def top(self) -> float:
        """its upper side [mm]"""
    @property
    def loops(self) -> tuple[numpy.typing.NDArray[numpy.float64], ...]:
        """n × 2 arrays [mm], read-only: outer loops anticlockwise, holes clockwise"""
    @property
    def area(self) -> float:
        """of what is solid [mm²]"""
    def to_shapely(self) -> Any:
        """The layer as a shapely MultiPolygon; needs shapely."""

class SliceOptions:
    def __init__(
        self,
        layer: float,
        adaptive: float,
        max_layer: float,
        heights: list[float],
        tolerance: float,
        compensation: float,
        threads: int,
    ) -> None: ...

class Solid:
    def __init__(self, path: str, text: str | None, options: dict[str, Any]) -> None: ...
    def with_values(self, values: list[tuple[str, str]]) -> Solid: ...
    def slice(self, options: SliceOptions) -> list[Layer]: ...
    def write(self, path: str, options: SliceOptions, printer: str, mirror: str) -> None: ...
    def thin_places(self, width: float, options: SliceOptions) -> list[Any]: ...
    def check(self, options: SliceOptions, self_supporting: float) -> list[Any]: ...
    def report(
        self, options: SliceOptions, self_supporting: float, min_feature: float
    ) -> str: ...
    def page(self, options: SliceOptions) -> str: ...
    def parameters(self) -> list[Any]: ...
    def supports(self) -> list[Any]: ...
    def messages(self) -> list[str]: ...

def inspect(path: str, self_supporting: float, min_feature: float) -> tuple[Any, ...]: ...
