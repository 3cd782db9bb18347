"""Which way each texel of a map shows, for the scripts that hold Sixfold against other programs.

Axes are those of src/mapping: x right, y up, z ahead, at the middle of a latlong; faces are +x -x +y -y +z -z. Written from the face
table, not from Sixfold's own pictures, so that the scripts can find it wrong.
"""

import numpy as np


def centred(count):
    """Samples in the middle of their squares."""
    return (np.arange(count) + 0.5) / count


def on_borders(count):
    """Samples of which the outermost lie on the chart's border."""
    return np.arange(count) / (count - 1)


def face(chart, size, sited=centred, warp=lambda c: c):
    """x, y, z of a face's texels, not of unit length; `warp` bends a coordinate in [-1, 1]."""
    a, b = np.meshgrid(*2 * [warp(sited(size) * 2 - 1)])
    one = np.ones_like(a)
    return [
        (one, -b, -a), (-one, -b, a), (a, one, b), (a, -one, -b), (a, -b, one), (-a, -b, -one),
    ][chart]


def equi_angular(c):
    """Equal steps of the coordinate are equal angles."""
    return np.tan(c * np.pi / 4)


def latlong(width, height, sited=centred):
    """x, y, z of a latlong's texels."""
    longitude, colatitude = np.meshgrid((sited(width) - 0.5) * 2 * np.pi, sited(height) * np.pi)
    return np.sin(colatitude) * np.sin(longitude), np.cos(colatitude), np.sin(colatitude) * np.cos(longitude)


def latlong_place(x, y, z):
    """u and v in [0, 1] of directions."""
    return 0.5 + np.arctan2(x, z) / (2 * np.pi), np.arctan2(np.hypot(x, z), y) / np.pi


def cube_place(x, y, z):
    """Chart, and u and v in [0, 1], of directions; where two faces meet z comes before y and y before x."""
    ax, ay, az = abs(x), abs(y), abs(z)
    is_z = (az >= ax) & (az >= ay)
    is_y = ~is_z & (ay >= ax)
    chart = np.where(is_z, 4 + (z < 0), np.where(is_y, 2 + (y < 0), x < 0))
    middle = np.where(is_z, az, np.where(is_y, ay, ax))
    u = (np.choose(chart, [-z, z, x, x, x, -x]) / middle + 1) / 2
    v = (np.choose(chart, [-y, -y, z, -z, -y, -y]) / middle + 1) / 2
    return chart, u, v
