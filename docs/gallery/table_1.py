"""Prints Table 1 from the files of `relievo bench SCAN --views 0 --json`, as Markdown. Usage: table_1.py FOLDER"""

import json
import sys
from pathlib import Path

# The paper's model: its visible and control points, t1 to t3 in milliseconds, and frames a second.
PAPER = {
    "scene_menagerie_front": "children 636699 7813 19 35 48 26.28",
    "gutenberg": "bust 104543 7924 17 26 7 38.38",
    "falcon": "eagle 388646 7913 18 33 27 30.16",
    "lion_takanawa": "lion 178120 6322 14 22 10 44.47",
    "armadillo": "armadillo 320108 8129 20 32 25 31.70",
    "squirrel": "squirrel 99331 6747 15 23 7 44.29",
    "horse": "horse 184202 10045 23 35 18 28.51",
    "bimba": "bimba 198457 7469 16 26 13 36.39",
    "dragon": "dragon 282472 8669 21 30 21 33.14",
    "fig-12-a": "12.a 328846 10755 25 38 21 26.18",
    "fig-12-b": "12.b 416327 9021 22 38 28 26.55",
    "happy_buddha": "buddha 173336 7314 17 26 11 38.35",
}


def cells(values):
    return "| " + " | ".join(str(value) for value in values) + " |"


figures = ["visible", "control", "t1", "t2", "t3", "fps"]
head = ["paper", *figures, "ours", *figures, "ahead", "exact", "ahead"]
print(cells(head))
print(cells(["---"] * len(head)))
for scan, row in PAPER.items():
    frames = json.loads((Path(sys.argv[1]) / f"{scan}.bench").read_text())["frames"]
    by_mode = {frame["mode"]: frame for frame in frames if frame["threads"] == max(f["threads"] for f in frames)}
    plain = by_mode["subspace, paper"]
    modes = [f"{of}, paper{how}" for of in ("subspace", "exact") for how in ("", ", one step ahead")]
    rates = [1e3 / by_mode[mode]["p50_ms"] for mode in modes]
    times = [f"{plain[key]:.2f}" for key in ("t1_ms", "t2_ms", "t3_ms")]
    own = [scan, plain["visible_points"], plain["control_points"], *times, *(f"{rate:.0f}" for rate in rates)]
    print(cells(row.split() + own))
