#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Makes the meshes of the bundled scenes: make_scene_meshes.py [FOLDER], by default scenes/meshes."""
import math
import pathlib
import sys


def write_obj(path, comment, vertices, faces):
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"# SPDX-License-Identifier: MIT\n# {comment}: made by tools/make_scene_meshes.py\n")
        out.writelines("v %.4f %.4f %.4f\n" % tuple(v) for v in vertices)
        out.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def turned(profile, pieces):
    """The line of (distance from the y axis, height), from top to bottom, turned around the axis."""
    vertices, rings, faces = [], [], []
    for radius, height in profile:
        if radius == 0:
            rings.append([len(vertices)] * pieces)
            vertices.append((0, height, 0))
            continue
        rings.append(list(range(len(vertices), len(vertices) + pieces)))
        angles = (2 * math.pi * p / pieces for p in range(pieces))
        vertices.extend((radius * math.cos(a), height, radius * math.sin(a)) for a in angles)
    for upper, lower in zip(rings, rings[1:]):
        for p in range(pieces):
            q = (p + 1) % pieces
            corners = [upper[p], upper[q], lower[q], lower[p]]
            faces.append([c for i, c in enumerate(corners) if c != corners[i - 1]])
    return vertices, faces


def hourglass():
    """Two bulbs of 1 m and a neck 0.2 m wide, 2.4 m high around 0."""
    def radius(height):
        bulb = abs(height) / 1.2
        return 0.1 + 0.5 * math.sin(math.pi / 2 * min(1, max(0, bulb - 0.04) / 0.7)) ** 1.5
    steps = [1.2 * (1 - 2 * i / 64) for i in range(65)]
    return turned([(0, 1.2)] + [(radius(h), h) for h in steps] + [(0, -1.2)], 64)


def tumbler():
    """A drinking glass 0.9 m high on 0, with walls 0.05 m thick and a round rim: from the inside of its floor over the rim
    to its foot."""
    thick, rim = 0.05, 0.875
    def inner(height):
        return 0.27 + 0.06 * height / 0.9
    inside = [(0, 0.09), (0.2, 0.09), (0.25, 0.1), (inner(0.14), 0.14)]
    inside += [(inner(h), h) for h in (0.3, 0.45, 0.6, 0.75, rim)]
    middle = inner(rim) + thick / 2
    over = [(middle - thick / 2 * math.cos(a), rim + thick / 2 * math.sin(a)) for a in
            (math.pi * k / 6 for k in range(1, 6))]
    outside = [(inner(h) + thick, h) for h in (rim, 0.75, 0.6, 0.45, 0.3, 0.14, 0.03)]
    return turned(inside + over + outside + [(0.29, 0), (0, 0)], 96)


def bumps(x, y, z):
    """Smooth bumps of several sizes, from -1 to 1 about."""
    total = 0
    for size, height, shift in ((1.3, 0.55, 0.2), (2.7, 0.3, 1.7), (5.9, 0.15, 4.1)):
        total += height * (math.sin(size * x + shift) * math.cos(1.1 * size * z - shift) +
                           math.sin(1.3 * size * y + 2 * shift) * math.cos(size * x + size * z))
    return total


def rock(rows=40, columns=80):
    """A boulder of about 1 m around 0: a ball with bumps and a flat foot."""
    def place(row, column):
        up, around = math.pi * row / rows, 2 * math.pi * column / columns
        x, y, z = math.sin(up) * math.cos(around), math.cos(up), math.sin(up) * math.sin(around)
        size = 1 + 0.28 * bumps(1.7 * x, 1.7 * y, 1.7 * z)
        return size * x, max(-0.75, 0.9 * size * y), size * z
    vertices = [place(0, 0)] + [place(r, c) for r in range(1, rows) for c in range(columns)] + [place(rows, 0)]
    def at(row, column):
        return 0 if row == 0 else len(vertices) - 1 if row == rows else 1 + (row - 1) * columns + column % columns
    faces = []
    for row in range(rows):
        for column in range(columns):
            corners = [at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)]
            faces.append([c for i, c in enumerate(corners) if c != corners[i - 1]])
    return vertices, faces


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "scenes/meshes")
    folder.mkdir(parents=True, exist_ok=True)
    write_obj(folder / "hourglass.obj", "An hourglass", *hourglass())
    write_obj(folder / "tumbler.obj", "A drinking glass", *tumbler())
    write_obj(folder / "rock.obj", "A boulder", *rock())


if __name__ == "__main__":
    main()
