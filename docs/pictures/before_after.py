"""Makes before-after.png: a generated scan, as points that are turned, and its relief.

Usage: before_after.py OUT.png
"""

import sys

import numpy as np
import relievo

HEIGHT = 480


def turned(points, yaw_deg, pitch_deg):
    """Returns the points or normals as seen from the left and from above."""
    y, p = np.radians([yaw_deg, pitch_deg])
    about_y = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(p), -np.sin(p)], [0, np.sin(p), np.cos(p)]])
    return points @ (about_x @ about_y).T


def backdrop(width):
    """Returns the grey behind a preview, which darkens downwards."""
    return np.repeat(np.linspace(235, 202, HEIGHT)[:, None, None], width, axis=1).repeat(3, axis=2)


def scan_picture(cloud, width):
    """Returns a picture of points as squares, the nearest in front, in the light of the previews, smoothed by halving."""
    points, normals = turned(cloud.points, 48, 18), turned(cloud.normals, 48, 18)
    light = np.array([-0.35, 0.55, 0.76])
    grey = 70 + 175 * np.clip(normals @ light / np.linalg.norm(light), 0, 1)
    middle = (points.max(axis=0) + points.min(axis=0)) / 2
    scale = 2 * 0.86 * min(HEIGHT / np.ptp(points[:, 1]), width / np.ptp(points[:, 0]))
    order = np.argsort(points[:, 2])  # from far to near
    order = order[normals[order, 2] > 0.05]
    columns, rows = ((points[order, :2] - middle[:2]) * [scale, -scale] + [width, HEIGHT]).astype(int).T
    picture = backdrop(width).repeat(2, axis=0).repeat(2, axis=1)
    nearest = np.full(picture.shape[:2], -1)
    for x in range(-2, 3):
        for y in range(-2, 3):
            np.maximum.at(nearest, (rows + y, columns + x), np.arange(len(order)))
    seen = nearest >= 0
    picture[seen] = grey[order][nearest[seen], None] * [0.98, 0.93, 0.84]
    return picture.reshape(HEIGHT, 2, width, 2, 3).mean(axis=(1, 3))


def main():
    cloud = relievo.sample("shell", points=1_000_000)
    relief = relievo.make(cloud, width_mm=80, height_mm=4).preview(960)
    front = relief[:, : relief.shape[1] // 2]
    rows = np.linspace(0, len(front) - 1, HEIGHT).astype(int)
    columns = np.linspace(0, front.shape[1] - 1, round(front.shape[1] * HEIGHT / len(front))).astype(int)
    oblique = relief[:, relief.shape[1] // 2 :][rows][:, columns]
    oblique = oblique[:, round(0.1 * oblique.shape[1]) : round(0.95 * oblique.shape[1])]
    parts = [scan_picture(cloud, 440), front[rows][:, columns], oblique]
    with open(sys.argv[1], "wb") as file:
        file.write(relievo.png(np.hstack(parts).round().astype("u1")))


if __name__ == "__main__":
    main()
