"""Tables 1, 2 and 3 as Zeng et al. 2011 print them.

Measured there on Windows XP with an Intel Core i5 750 at 2.67 GHz and 3 GB.
T_T is T_C + T_L, without reading and writing. Times in seconds, sizes in MB.
"""
from dataclasses import dataclass


@dataclass(frozen=True)
class Stages:
    depth_images: float  # T_C
    loops: float         # T_L
    total: float         # T_T


@dataclass(frozen=True)
class Ring:
    """A row of Table 1, a ring at 0.0762 mm. Other programs as printed."""
    triangles: int
    stages: Stages
    infinyslice: str
    rhinoceros: str


@dataclass(frozen=True)
class Images:
    """A row of Table 3, by the paper's word for the images: "normal" (each leaf
    in the box of the scene) or "adaptive" (each in its own)."""
    seconds: dict  # T_T
    megabytes: dict


def images(normal_seconds, normal_megabytes, seconds, megabytes):
    return Images({"normal": normal_seconds, "adaptive": seconds},
                  {"normal": normal_megabytes, "adaptive": megabytes})


# By chordal error, mm.
TABLE1 = {
    0.1: Ring(1530, Stages(0.109, 0.188, 0.297), "1", "< 1"),
    0.01: Ring(17308, Stages(0.156, 0.172, 0.328), "2", "2"),
    0.001: Ring(113692, Stages(0.266, 0.187, 0.453), "5", "13"),
    0.0001: Ring(1401978, Stages(2.313, 0.187, 2.500), "13", "106"),
}

# A horse at a chordal error of 0.001 mm, by resolution, mm.
TABLE2 = {
    0.1524: Stages(0.359, 0.063, 0.422),
    0.0762: Stages(0.406, 0.140, 0.546),
    0.0381: Stages(0.562, 0.485, 1.047),
    0.0127: Stages(2.328, 3.984, 6.312),
}

# The figure that shows the model for which a scene of bench/scenes stands: a
# ring of 55 components, a submarine of 74.
FIGURES = {"ring55": "Fig. 13", "submarine74": "Fig. 16"}

# By that scene and resolution, mm.
TABLE3 = {
    ("ring55", 0.1524): images(5.4, 6.45, 4.8, 0.39),
    ("ring55", 0.0762): images(10.5, 27.26, 10.1, 1.89),
    ("ring55", 0.0381): images(32.3, 130.47, 28.0, 8.95),
    ("ring55", 0.0127): images(232.3, 1289.03, 215.7, 86.50),
    ("submarine74", 0.1524): images(4.3, 1.38, 4.0, 0.05),
    ("submarine74", 0.0762): images(5.1, 5.6, 4.9, 0.25),
    ("submarine74", 0.0381): images(7.3, 22.12, 6.5, 1.11),
    ("submarine74", 0.0127): images(26.6, 216.11, 19.4, 10.38),
}
