"""Layers as shapes of shapely, which is loaded only here."""

from __future__ import annotations

from typing import Any

import numpy
import shapely.geometry  # type: ignore[import]

from ._lamina import Layer


def polygons_of(layer: Layer) -> Any:
    """A MultiPolygon: each outer loop with the holes that it holds."""
    rings = [shapely.geometry.Polygon(loop) for loop in layer.loops]
    outer = [ring for ring in rings if ring.exterior.is_ccw]
    holes: list[list[Any]] = [[] for _ in outer]
    for hole in rings:
        if hole.exterior.is_ccw:
            continue
        # Loops are disjoint: one point decides. The smallest is the nearest.
        point = shapely.geometry.Point(hole.exterior.coords[0])
        around = [i for i, ring in enumerate(outer) if ring.covers(point)]
        holes[min(around, key=lambda i: float(outer[i].area))].append(
            numpy.asarray(hole.exterior.coords)
        )
    return shapely.geometry.MultiPolygon(
        [
            shapely.geometry.Polygon(numpy.asarray(ring.exterior.coords), inside)
            for ring, inside in zip(outer, holes)
        ]
    )
