"""OpenSCAD 2025.07.18, the oracle of language 2026, for the benchmarks
(tests/support/openscad_2026.mjs; scripts/test fetches it)."""
from measure import ROOT

OPENSCAD_2026 = [ROOT / "tests/support/openscad_2026.mjs"]

# What newer snapshots have without being asked, and lamina has always.
FEATURES = [f"--enable={feature}" for feature in
            ("roof", "textmetrics", "import-function", "object-function")]
