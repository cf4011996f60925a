"""Whether the layers of a design agree with a mesh or a drawing that openscad
made of it.

`lamina compare` compares all layers: they agree if no contour is farther than
its tolerance, 0.001 mm (0.002 in drawings), from the other program's.
Where they do not, exact sections of the mesh judge the layers that differ most,
as in the Geometry tests (tests/conformance/geometry_judge.h): they agree but
for rounding, the mesh is no judge, or they differ.
"""
import json
import math
import tempfile
from pathlib import Path

from measure import LAMINA, Failure, run_process

LAMINA_LIMIT = 300  # seconds of processor time for a comparison
DRAWING_GRID = 0.001  # mm
DRAWING_CODES = ("10", "11", "20", "21")  # coordinates in a .dxf
MOST_HEIGHTS = 7  # that a design is judged at
JUDGE = LAMINA.parent / "tests/conformance/geometry_judge"

AGREE, ROUNDING = "agree", "agree but for rounding"
NO_JUDGE, DIFFER = "openscad's mesh is no judge", "differ"
BECAME = {"equal": ROUNDING, "no-judge": NO_JUDGE, "differs": DIFFER}


def is_random(design, options=(), environment=None):
    """Whether random numbers shape the design."""
    with tempfile.TemporaryDirectory() as scratch:
        texts = []
        for seed in "01":
            output = Path(scratch, f"{seed}.csg")
            try:
                run_process([LAMINA, design, "-q", *options, "--seed", seed,
                             "-o", output], LAMINA_LIMIT,
                            environment=environment)
            except Failure:
                return False  # The comparison will tell why.
            texts.append(output.read_bytes())
    return texts[0] != texts[1]


def sum_of_differences(row):
    return row["only_a"] + row["only_b"]


def distance(row):
    return math.inf if row["distance"] is None else row["distance"]


def drawing_tolerance(drawing):
    """openscad writes six digits of a coordinate, and lamina reads drawings on a
    grid of 0.001 mm, as openscad does: twice the larger of the two units
    [mm]."""
    lines = [line.strip() for line in drawing.read_text().splitlines()]
    greatest = max((abs(float(value)) for code, value in
                    zip(lines[::2], lines[1::2]) if code in DRAWING_CODES),
                   default=1)
    digits_before = math.floor(math.log10(max(greatest, 1))) + 1
    return 2 * max(DRAWING_GRID, 10.0 ** (digits_before - 6))


def compare(design, mesh, words, layer, language="auto", environment=None):
    """What became of the design: the fields of its row in a list. `words` is a
    file with what openscad said when it made the mesh."""
    options = ["--language", language]
    tolerance = (["--tolerance", str(drawing_tolerance(mesh))]
                 if mesh.suffix == ".dxf" else [])
    with tempfile.TemporaryDirectory() as scratch:
        report = Path(scratch, "report.json")
        try:
            run_process([LAMINA, "compare", design, mesh, "-q", *options,
                         *tolerance, "--layer", str(layer), "--report", report],
                        LAMINA_LIMIT, environment=environment)
        except Failure as failure:
            if not report.exists():
                return {"became": DIFFER, "why": str(failure)}
        found = json.loads(report.read_text())
    layers = found["layers"]
    farthest = max(map(distance, layers), default=0)
    result = {
        "became": AGREE, "layers": len(layers),
        "outside": found["layers_outside"], "volume": found["volume_a"],
        "only_lamina": found["volume_only_a"],
        "only_openscad": found["volume_only_b"],
        "distance": farthest if math.isfinite(farthest) else None,
        "area": max(map(sum_of_differences, layers), default=0),
        "share": max((sum_of_differences(row) /
                      (max(row["area_a"], row["area_b"]) or 1)
                      for row in layers), default=0)}
    if not found["equal"]:
        result.update({"became": DIFFER, "why": "an outline"}
                      if mesh.suffix == ".dxf" else
                      judge(design, mesh, words, found, options, environment))
    return result


def judge(design, mesh, words, found, options, environment):
    """What exact sections of the mesh say of the layers that differ most."""
    outside = [row for row in found["layers"]
               if distance(row) > found["tolerance"]]
    outside.sort(key=lambda row: (distance(row), sum_of_differences(row)))
    heights = sorted(row["z"] for row in outside[-MOST_HEIGHTS:])
    try:
        words = run_process([JUDGE, *options, design, mesh, words,
                             *map(str, heights)],
                            LAMINA_LIMIT, environment=environment).output
    except Failure as failure:
        return {"became": DIFFER, "why": str(failure)}
    verdict, _, why = words.partition("\n")
    return {"became": BECAME[verdict], "why": why.strip()}


def print_difference(row):
    print(f"{row['became']}: {row['design']}")
    if "layers" in row:
        far = ("some in one program only" if row["distance"] is None
               else f"at most {row['distance']:.2g} mm")
        print(f"    {row['outside']} of {row['layers']} layers, {far}, at most "
              f"{row['area']:.2g} mm²")
    if row["why"]:
        print(f"    {row['why'].splitlines()[0]}")
