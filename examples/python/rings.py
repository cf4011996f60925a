"""A solitaire in eight sizes: a table of volumes and weights.

    python3 examples/python/rings.py
"""

from pathlib import Path

import lamina
import pandas as pd  # type: ignore[import]

DESIGN = Path(__file__).parents[1] / "solitaire.scad"

ring = lamina.Design(DESIGN, material="bluecast-x10", metal="gold-750")
rows = []
for size in range(48, 64, 2):
    report = ring.with_(ring_size=size).report(layer=0.1)
    rows.append(
        {
            "size": size,
            "height": report["size"][2],
            "layers": report["layers"],
            "resin ml": report["material"]["millilitres"],
            "gold g": report["metal"]["grams"],
        }
    )
table = pd.DataFrame(rows).set_index("size")
print(table.round(2).to_string())
