"""Measures how the steepness of a relief grows with its height, in frames of one session. Usage: sweep.py SCAN"""

import sys

import numpy as np
import relievo

session = relievo.Session(sys.argv[1], width_mm=80)
print("height    median slope")
for height in np.linspace(1, 10, 10):
    frame = session.frame(height_mm=float(height))
    slopes = np.degrees(np.arccos(frame.normals[:, 2]))
    print(f"{frame.height_mm:6.2f} mm  {np.median(slopes):5.1f} degrees")
