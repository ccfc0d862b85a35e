#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes office.obj and office.mtl beside this script: a side-lit office as a CAD tool exports one.

Metres, z up, y north; the room is 0 ≤ x ≤ 6, 0 ≤ y ≤ 8, 0 ≤ z ≤ 3. Each part is closed and made of quads that face
outwards; parts stand on each other and abut, nothing is trimmed or merged for the sake of a calculation."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from parts import ObjFile, chair, legs, mtl_text, shell, window, window_wall  # noqa: E402

# Material: (diffuse reflectance as its colour in the MTL, opacity)
MATERIALS = {
    "floor": (0.20, 1.0), "ceiling": (0.75, 1.0), "wall": (0.55, 1.0), "partition": (0.45, 1.0),
    "facade": (0.35, 1.0), "concrete": (0.30, 1.0), "frame": (0.60, 1.0), "glazing": (0.90, 0.3),
    "wood": (0.40, 1.0), "metal": (0.30, 1.0), "fabric": (0.25, 1.0), "obstruction": (0.30, 1.0), "ground": (0.20, 1.0),
}


def desk(obj, name, x, y):
    obj.part(name)
    obj.box((x, y, 0.72), (x + 0.8, y + 1.6, 0.75), "wood")
    legs(obj, (x, y), (x + 0.8, y + 1.6), 0.05, 0.72, "metal")


def main():
    obj = ObjFile("office")
    windows, sill, head = [(0.6, 2.4), (3.6, 5.4)], 0.9, 2.4
    shell(obj, 6, 8)
    window_wall(obj, windows, sill, head, 6)
    for name, (x0, x1) in zip(("window_left", "window_right"), windows):
        window(obj, name, x0, x1, sill, head)
    for number, (x, y) in enumerate([(0.9, 1.0), (4.3, 1.0), (0.9, 5.0), (4.3, 5.0)], 1):
        desk(obj, f"desk_{number}", x, y)
        if x < 3:
            chair(obj, f"chair_{number}", 1.75, y + 0.55, 2.17)
        else:
            chair(obj, f"chair_{number}", 3.80, y + 0.55, 3.80)
    obj.part("partition")
    obj.box((1.5, 3.98, 0), (4.5, 4.02, 1.5), "partition")
    obj.part("building_opposite")
    obj.box((-9, -28, -0.3), (15, -18, 8.7), "obstruction")
    (HERE / "office.obj").write_text(obj.text())
    (HERE / "office.mtl").write_text(mtl_text(MATERIALS))


if __name__ == "__main__":
    main()
