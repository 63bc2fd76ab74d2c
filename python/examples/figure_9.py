"""The paper's Fig. 9: one scan at five saturations, side by side. Usage: figure_9.py SCAN [PICTURE.png]"""

import sys
from pathlib import Path

import numpy as np
import relievo

picture = sys.argv[2] if len(sys.argv) > 2 else "figure_9.png"
session = relievo.Session(sys.argv[1], method="paper", height_mm=5, resolution_mm=0.25)
fronts = []
for saturation in (0, 2.5, 5, 7.5, 10):
    both = session.make(saturation=saturation).preview(400)
    fronts.append(both[:, : both.shape[1] // 2])  # the right half is the oblique view
Path(picture).write_bytes(relievo.png(np.hstack(fronts)))
