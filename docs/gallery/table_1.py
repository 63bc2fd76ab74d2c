"""Prints Table 1 from the files of `relievo bench SCAN --views 0 --json`, as Markdown. Usage: table_1.py FOLDER"""

import json
import sys
from pathlib import Path

# The paper's model for each of our scans.
MODELS = {
    "scene_menagerie_front": "children",
    "gutenberg": "bust",
    "falcon": "eagle",
    "lion_takanawa": "lion",
    "armadillo": "armadillo",
    "squirrel": "squirrel",
    "horse": "horse",
    "bimba": "bimba",
    "dragon": "dragon",
    "fig-12-a": "models (12.a)",
    "fig-12-b": "models (12.b)",
    "happy_buddha": "buddha",
}


def cells(values):
    return "| " + " | ".join(str(value) for value in values) + " |"


figures = ["visible", "control", "t1", "t2", "t3", "fps"]
head = ["paper", *figures, "ours", *figures, "ahead", "exact", "ahead"]
print(cells(head))
print(cells(["---"] * len(head)))
for scan, model in MODELS.items():
    figures_of_scan = json.loads((Path(sys.argv[1]) / f"{scan}.bench").read_text())
    frames = figures_of_scan["frames"]
    row = next(row for row in figures_of_scan["paper_table_1"] if row[0] == model)
    by_mode = {frame["mode"]: frame for frame in frames if frame["threads"] == max(f["threads"] for f in frames)}
    plain = by_mode["subspace, paper"]
    modes = [f"{of}, paper{how}" for of in ("subspace", "exact") for how in ("", ", one step ahead")]
    rates = [1e3 / by_mode[mode]["p50_ms"] for mode in modes]
    times = [f"{plain[key]:.2f}" for key in ("t1_ms", "t2_ms", "t3_ms")]
    own = [scan, plain["visible_points"], plain["control_points"], *times, *(f"{rate:.0f}" for rate in rates)]
    print(cells(row + own))
