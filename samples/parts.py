# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts of the samples share: OBJ files part by part, as a CAD tool exports them, and the furniture of rooms. Metres, z up."""

# Faces of a box by the corners they have, bit 0 x, bit 1 y, bit 2 z, counter-clockwise from outside.
BOX = {"west": (0, 4, 6, 2), "east": (1, 3, 7, 5), "south": (0, 1, 5, 4), "north": (2, 6, 7, 3),
       "bottom": (0, 2, 3, 1), "top": (4, 5, 7, 6)}
NORMALS = {"west": (-1, 0, 0), "east": (1, 0, 0), "south": (0, -1, 0), "north": (0, 1, 0), "bottom": (0, 0, -1),
           "top": (0, 0, 1)}


class ObjFile:
    """Parts one after the other, with vertices shared as a modeller shares them."""

    def __init__(self, name):
        self.name = name
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
        lines = [f"# Clerestory sample: {self.name}. Metres, z up.", f"mtllib {self.name}.mtl"]
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


def window_wall(obj, windows, sill, head, width):
    """The south wall, 0.3 m thick, in strips beside, under and over the windows; the reveals are its sides there."""
    obj.part("wall_south")
    inner, outer, low, high = 0.0, -0.3, -0.3, 3.0
    edges = [-0.3] + [x for window in windows for x in window] + [width + 0.3]

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


def shell(obj, width, depth):
    """Ground, slabs and the walls without windows of a room 3 m high whose window wall is that to the south."""
    obj.part("ground")
    obj.quad([(-57, -60, -0.3), (63, -60, -0.3), (63, 60, -0.3), (-57, 60, -0.3)], (0, 0, 1), "ground")
    obj.part("slab_floor")
    obj.box((0, 0, -0.3), (width, depth, 0), "concrete", top="floor")
    obj.part("slab_roof")
    obj.box((-0.3, -0.3, 3), (width + 0.3, depth + 0.3, 3.3), "facade", bottom="ceiling")
    obj.part("wall_north")
    obj.box((-0.3, depth, -0.3), (width + 0.3, depth + 0.3, 3), "facade", south="wall")
    obj.part("wall_west")
    obj.box((-0.3, 0, -0.3), (0, depth, 3), "facade", east="wall")
    obj.part("wall_east")
    obj.box((width, 0, -0.3), (width + 0.3, depth, 3), "facade", west="wall")


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


def chair(obj, name, x, y, back_x):
    """Seat 0.45 × 0.45 m at 0.46 m; the back stands on the seat at x = back_x."""
    obj.part(name)
    obj.box((x, y, 0.43), (x + 0.45, y + 0.45, 0.46), "fabric")
    obj.box((back_x, y, 0.46), (back_x + 0.03, y + 0.45, 0.90), "fabric")
    legs(obj, (x + 0.02, y + 0.02), (x + 0.43, y + 0.43), 0.03, 0.43, "metal")


def mtl_text(materials):
    """Of materials with their diffuse reflectance as colour, and opacity."""
    return "".join(f"newmtl {name}\nKd {grey:.3f} {grey:.3f} {grey:.3f}\nd {opacity:.1f}\n\n"
                   for name, (grey, opacity) in materials.items())
