"""OpenSCAD 2025.07.18, the oracle of language 2026, for the benchmarks
(tests/support/openscad_2026.mjs; scripts/test fetches it)."""
import hashlib
import json
import os
import re

from measure import ROOT, Failure, Stopped, run_process

OPENSCAD_2026 = [ROOT / "tests/support/openscad_2026.mjs"]

# What newer snapshots have without being asked, and lamina has always.
FEATURES = [f"--enable={feature}" for feature in
            ("roof", "textmetrics", "import-function", "object-function")]

# Newer snapshots export what there was before such an error.
EVALUATION_ERROR = re.compile(r"^ERROR: (Assertion|Recursion) ", re.M)

# What became of a design of which it makes no solid and no outline.
SLOW, FAILS, NOTHING = "slow", "fail", "nothing"


class Oracle:
    """What OpenSCAD makes of designs, kept in a folder."""

    def __init__(self, folder, limit):
        self.folder = folder
        self.limit = limit
        folder.mkdir(parents=True, exist_ok=True)

    def render(self, name, design, environment):
        """A dictionary: what became of the design of that name, the seconds
        that it took, and the paths of OpenSCAD's words and of its mesh or
        drawing, if any."""
        key = hashlib.md5(os.fsencode(name) + design.read_bytes()).hexdigest()
        answer = self.folder / f"{key}.json"
        if not answer.exists():
            answer.write_text(json.dumps(
                self.ask(design, self.folder / key, environment)))
        return json.loads(answer.read_text())

    def ask(self, design, stem, environment):
        result = self.export(design, stem.with_suffix(".stl"), environment)
        if "not a 3D object" in result["said"]:
            result = self.export(design, stem.with_suffix(".dxf"), environment)
        words = stem.with_suffix(".words")
        words.write_text(result.pop("said"))
        return {**result, "words": str(words)}

    def export(self, design, output, environment):
        result = {"became": FAILS, "seconds": 0, "said": ""}
        try:
            cost = run_process(
                [*OPENSCAD_2026, *FEATURES, "--backend=Manifold",
                 *(["--export-format=binstl"] if output.suffix == ".stl"
                   else []), "-o", output, design],
                self.limit, design.parent, environment)
        except Stopped as stopped:
            return {**result, "became": SLOW, "seconds": stopped.seconds}
        except Failure as failure:
            said = str(failure)
            empty = "object is empty" in said and "ERROR" not in said
            return {**result, "became": NOTHING if empty else FAILS,
                    "said": said}
        if EVALUATION_ERROR.search(cost.output):
            return {**result, "said": cost.output}
        return {"became": "", "seconds": cost.seconds, "said": cost.output,
                "mesh": str(output)}
