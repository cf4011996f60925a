"""The area of a ring's layers by height: jumps are what pulls at a print.

    python3 examples/python/area.py area.png
"""

import sys
from pathlib import Path

import lamina
import matplotlib.pyplot as plt  # type: ignore[import]

DESIGN = Path(__file__).parents[1] / "solitaire.scad"

layers = lamina.Design(DESIGN).slice(layer=0.05)
figure, axes = plt.subplots(figsize=(6, 4))
axes.plot([layer.z for layer in layers], [layer.area for layer in layers])
axes.set_xlabel("height [mm]")
axes.set_ylabel("area [mm²]")
axes.set_title(DESIGN.stem)
figure.savefig(sys.argv[1], dpi=120)
