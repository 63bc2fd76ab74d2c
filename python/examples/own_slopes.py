"""Makes a surface from given slopes: a wave that fades towards the boundary. Usage: own_slopes.py"""

from pathlib import Path

import numpy as np
import relievo

x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(-1, 1, 200), np.linspace(-1, 1, 200)))
points = np.column_stack([x, y])
slopes = np.column_stack([np.cos(12 * x) * (1 - y * y), np.sin(3 * y) * (1 - x * x)])
heights = relievo.solve_heights(points, slopes)

shown = heights.reshape(200, 200)[::-1]
grey = (255 * (shown - shown.min()) / np.ptp(shown)).astype(np.uint8)
Path("own_slopes.png").write_bytes(relievo.png(grey))
