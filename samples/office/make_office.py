#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes office.obj and office.mtl beside this script: a side-lit office as a CAD tool exports one.

Metres, z up, y north; the room is 0 ≤ x ≤ 6, 0 ≤ y ≤ 8, 0 ≤ z ≤ 3. Each part is closed and made of quads that face
outwards; parts stand on each other and abut, nothing is trimmed or merged for the sake of a calculation."""
from pathlib import Path

HERE = Path(__file__).resolve().parent

# Material: (diffuse reflectance as its colour in the MTL, opacity)
MATERIALS = {
    "floor": (0.20, 1.0), "ceiling": (0.75, 1.0), "wall": (0.55, 1.0), "partition": (0.45, 1.0),
    "facade": (0.35, 1.0), "concrete": (0.30, 1.0), "frame": (0.60, 1.0), "glazing": (0.90, 0.3),
    "wood": (0.40, 1.0), "metal": (0.30, 1.0), "fabric": (0.25, 1.0), "obstruction": (0.30, 1.0), "ground": (0.20, 1.0),
}
# Faces of a box by the corners they have, bit 0 x, bit 1 y, bit 2 z, counter-clockwise from outside.
BOX = {"west": (0, 4, 6, 2), "east": (1, 3, 7, 5), "south": (0, 1, 5, 4), "north": (2, 6, 7, 3),
       "bottom": (0, 2, 3, 1), "top": (4, 5, 7, 6)}
NORMALS = {"west": (-1, 0, 0), "east": (1, 0, 0), "south": (0, -1, 0), "north": (0, 1, 0), "bottom": (0, 0, -1),
           "top": (0, 0, 1)}


class ObjFile:
    """Parts one after the other, with vertices shared as a modeller shares them."""

    def __init__(self):
        self.vertices, self.normals, self.parts = {}, {}, []

    def part(self, name):
        self.parts.append((name, []))

    def quad(self, corners, normal, material):
        v = [self.vertices.setdefault(c, len(self.vertices) + 1) for c in corners]
        n = self.normals.setdefault(normal, len(self.normals) + 1)
        self.parts[-1][1].append((material, v, n))

    def box(self, low, high, material, without=(), **by_side):
        """A box; sides listed in `without` are left out, others may have a material of their own."""
        for side, corners in BOX.items():
            if side not in without:
                points = [tuple(round((high if c >> axis & 1 else low)[axis], 6) for axis in range(3)) for c in corners]
                self.quad(points, NORMALS[side], by_side.get(side, material))

    def text(self):
        lines = ["# Clerestory sample: office. Metres, z up.", "mtllib office.mtl"]
        lines += ["v %.6f %.6f %.6f" % v for v in self.vertices] + ["vn %.4f %.4f %.4f" % n for n in self.normals]
        for name, quads in self.parts:
            lines.append("o " + name)
            current = None
            for material, v, n in quads:
                if material != current:
                    lines.append("usemtl " + material)
                    current = material
                lines.append("f " + " ".join(f"{i}//{n}" for i in v))
        return "\n".join(lines) + "\n"


def window_wall(obj, windows, sill, head):
    """The south wall, 0.3 m thick, in strips beside, under and over the windows; the reveals are its sides there."""
    obj.part("wall_south")
    inner, outer, low, high = 0.0, -0.3, -0.3, 3.0
    edges = [-0.3] + [x for window in windows for x in window] + [6.3]

    def skin(x0, x1, z0, z1):
        obj.quad([(x1, inner, z0), (x0, inner, z0), (x0, inner, z1), (x1, inner, z1)], (0, 1, 0), "wall")
        obj.quad([(x0, outer, z0), (x1, outer, z0), (x1, outer, z1), (x0, outer, z1)], (0, -1, 0), "facade")

    for x0, x1 in zip(edges[0::2], edges[1::2]):
        skin(x0, x1, low, high)
    for x0, x1 in windows:
        skin(x0, x1, low, sill)
        skin(x0, x1, head, high)
        obj.quad([(x0, outer, sill), (x1, outer, sill), (x1, inner, sill), (x0, inner, sill)], (0, 0, 1), "wall")
        obj.quad([(x0, outer, head), (x0, inner, head), (x1, inner, head), (x1, outer, head)], (0, 0, -1), "wall")
        obj.quad([(x0, outer, sill), (x0, inner, sill), (x0, inner, head), (x0, outer, head)], (1, 0, 0), "wall")
        obj.quad([(x1, outer, sill), (x1, outer, head), (x1, inner, head), (x1, inner, sill)], (-1, 0, 0), "wall")
    x0, x1 = edges[0], edges[-1]
    obj.quad([(x0, outer, low), (x0, inner, low), (x1, inner, low), (x1, outer, low)], (0, 0, -1), "concrete")
    obj.quad([(x0, outer, high), (x1, outer, high), (x1, inner, high), (x0, inner, high)], (0, 0, 1), "concrete")
    obj.quad([(x0, inner, low), (x0, outer, low), (x0, outer, high), (x0, inner, high)], (-1, 0, 0), "facade")
    obj.quad([(x1, outer, low), (x1, inner, low), (x1, inner, high), (x1, outer, high)], (1, 0, 0), "facade")


def shell(obj):
    """Ground, slabs and the walls without windows."""
    obj.part("ground")
    obj.quad([(-57, -60, -0.3), (63, -60, -0.3), (63, 60, -0.3), (-57, 60, -0.3)], (0, 0, 1), "ground")
    obj.part("slab_floor")
    obj.box((0, 0, -0.3), (6, 8, 0), "concrete", top="floor")
    obj.part("slab_roof")
    obj.box((-0.3, -0.3, 3), (6.3, 8.3, 3.3), "facade", bottom="ceiling")
    obj.part("wall_north")
    obj.box((-0.3, 8, -0.3), (6.3, 8.3, 3), "facade", south="wall")
    obj.part("wall_west")
    obj.box((-0.3, 0, -0.3), (0, 8, 3), "facade", east="wall")
    obj.part("wall_east")
    obj.box((6, 0, -0.3), (6.3, 8, 3), "facade", west="wall")


def window(obj, name, x0, x1, sill, head):
    """A frame of 5 cm, the pane in the middle of it, and a board on the sill inside."""
    y0, y1, w = -0.15, -0.09, 0.05
    obj.part(name + "_frame")
    obj.box((x0, y0, sill), (x0 + w, y1, head), "frame")
    obj.box((x1 - w, y0, sill), (x1, y1, head), "frame")
    obj.box((x0 + w, y0, sill), (x1 - w, y1, sill + w), "frame")
    obj.box((x0 + w, y0, head - w), (x1 - w, y1, head), "frame")
    obj.part(name + "_pane")
    left, right, bottom, top = (round(v, 6) for v in (x0 + w, x1 - w, sill + w, head - w))
    obj.quad([(left, -0.12, bottom), (right, -0.12, bottom), (right, -0.12, top), (left, -0.12, top)], (0, -1, 0),
             "glazing")
    obj.part(name + "_sill")
    obj.box((x0, y1, sill), (x1, 0.08, sill + 0.03), "wood")


def legs(obj, low, high, width, height, material):
    """Four square legs inside the corners of a rectangle, standing on the floor."""
    for x in (low[0], high[0] - width):
        for y in (low[1], high[1] - width):
            obj.box((x, y, 0), (x + width, y + width, height), material)


def desk(obj, name, x, y):
    obj.part(name)
    obj.box((x, y, 0.72), (x + 0.8, y + 1.6, 0.75), "wood")
    legs(obj, (x, y), (x + 0.8, y + 1.6), 0.05, 0.72, "metal")


def chair(obj, name, x, y, back_x):
    """Seat 0.45 × 0.45 m at 0.46 m; the back stands on the seat at x = back_x."""
    obj.part(name)
    obj.box((x, y, 0.43), (x + 0.45, y + 0.45, 0.46), "fabric")
    obj.box((back_x, y, 0.46), (back_x + 0.03, y + 0.45, 0.90), "fabric")
    legs(obj, (x + 0.02, y + 0.02), (x + 0.43, y + 0.43), 0.03, 0.43, "metal")


def main():
    obj = ObjFile()
    windows, sill, head = [(0.6, 2.4), (3.6, 5.4)], 0.9, 2.4
    shell(obj)
    window_wall(obj, windows, sill, head)
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
    (HERE / "office.mtl").write_text("".join(
        f"newmtl {name}\nKd {grey:.3f} {grey:.3f} {grey:.3f}\nd {opacity:.1f}\n\n"
        for name, (grey, opacity) in MATERIALS.items()))


if __name__ == "__main__":
    main()
