#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a city block of furnished offices as OBJ and MTL, of exactly the number of triangles asked for.

    benchmarks/city_block.py 100000 -o block.obj

Houses of six storeys with twenty offices each stand in a square block, 12 m apart. An office of 4 m x 5 m x 3 m has a floor slab,
three solid walls, a facade with a window and its pane, a door left open, and furniture: desk, chair, cupboard, shelf with books, screen,
lamp. Solids stand on each other as CAD tools leave them: a leg's foot lies in the plane of the floor, walls butt. What is missing to
the number of triangles is made up with books, and with sheets of paper on the last desk. No randomness: the same call gives the same file.
"""
import argparse
import math
import sys
from pathlib import Path

WIDTH, DEPTH, HEIGHT = 4.0, 5.0, 3.0  # of an office between the middles of its walls [m]
WALL, SLAB = 0.2, 0.3  # thickness [m]
STOREYS, OFFICES_A_STOREY, STREET = 6, 20, 12.0
BOOKS_A_SHELF = 24
BOX_TRIANGLES = 12

# name: diffuse colour
MATERIALS = {
    "concrete": 0.4, "plaster": 0.7, "glass": 0.1, "wood": 0.35, "metal": 0.3, "fabric": 0.2,
    "screen": 0.05, "lamp": 0.8, "paper": 0.75, "book": 0.25,
}

UNIT_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


class Writer:
    """Triangles with part and material; vertices are shared within a solid, not between solids."""

    def __init__(self, out):
        self.out = out
        self.vertices = 0
        self.triangles = 0
        self.material = None

    def begin(self, part, material):
        self.out.write(f"g {part}\n")
        self.out.write(f"usemtl {material}\n")

    def mesh(self, points, faces):
        self.out.writelines(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points)
        base = self.vertices + 1
        for face in faces:
            for i in range(2, len(face)):
                self.out.write(f"f {base + face[0]} {base + face[i - 1]} {base + face[i]}\n")
                self.triangles += 1
        self.vertices += len(points)

    def box(self, low, high):
        (x, y, z), (X, Y, Z) = low, high
        self.mesh([(x, y, z), (X, y, z), (X, Y, z), (x, Y, z), (x, y, Z), (X, y, Z), (X, Y, Z), (x, Y, Z)], UNIT_FACES)

    def facade(self, origin, size, hole_low, hole_high):
        """A wall in the xz plane, thick along y, with a rectangular hole and its reveals: a closed solid."""
        x, y, z = origin
        X, Y, Z = x + size[0], y + size[1], z + size[2]
        (hx, hz), (hX, hZ) = hole_low, hole_high
        points = []
        for depth in (y, Y):
            points += [(x, depth, z), (X, depth, z), (X, depth, Z), (x, depth, Z)]
            points += [(hx, depth, hz), (hX, depth, hz), (hX, depth, hZ), (hx, depth, hZ)]
        faces = []
        for k in range(4):
            n = (k + 1) % 4
            faces.append((k, n, 4 + n, 4 + k))  # outer face
            faces.append((8 + n, 8 + k, 12 + k, 12 + n))  # inner face
            faces.append((n, k, 8 + k, 8 + n))  # rim
            faces.append((4 + k, 4 + n, 12 + n, 12 + k))  # reveal
        self.mesh(points, faces)


def add_books(out, origin, first, count):
    """Books in a row on a board of the shelf, upright, of varying height."""
    x, y, z = origin
    for i in range(first, first + count):
        board, place = divmod(i, BOOKS_A_SHELF)
        height = 0.2 + 0.012 * (i * 7 % 11)
        left = x + 0.035 + 0.036 * place
        low = z + 0.02 + 0.4 * (board % 5)
        depth = 0.02 + 0.14 * (board // 5)  # more rows behind each other where there are many
        out.box((left, y + depth, low), (left + 0.03, y + depth + 0.12, low + height))


def add_furniture(out, x, y, z, name):
    out.begin(f"{name}-desk", "wood")
    out.box((x + 1.2, y + 1.0, z + 0.72), (x + 2.8, y + 1.8, z + 0.75))
    out.begin(f"{name}-desk", "metal")
    for lx in (1.22, 2.72):
        for ly in (1.02, 1.72):
            out.box((x + lx, y + ly, z), (x + lx + 0.06, y + ly + 0.06, z + 0.72))
    out.begin(f"{name}-screen", "screen")
    out.box((x + 1.7, y + 1.2, z + 0.75), (x + 2.3, y + 1.22, z + 1.15))
    out.begin(f"{name}-chair", "fabric")
    out.box((x + 1.75, y + 2.0, z + 0.44), (x + 2.25, y + 2.5, z + 0.5))
    out.box((x + 1.75, y + 2.46, z + 0.5), (x + 2.25, y + 2.5, z + 1.0))
    out.begin(f"{name}-chair", "metal")
    for lx in (1.77, 2.19):
        for ly in (2.02, 2.44):
            out.box((x + lx, y + ly, z), (x + lx + 0.04, y + ly + 0.04, z + 0.44))
    out.begin(f"{name}-cupboard", "wood")
    out.box((x + 0.2, y + 3.0, z), (x + 0.65, y + 4.2, z + 1.8))
    out.begin(f"{name}-shelf", "wood")
    for board in range(6):
        out.box((x + 2.82, y + 4.4, z + 0.4 * board), (x + 3.78, y + 4.7, z + 0.4 * board + 0.02))
    for side in (2.8, 3.78):
        out.box((x + side, y + 4.4, z), (x + side + 0.02, y + 4.7, z + 2.02))
    out.begin(f"{name}-lamp", "lamp")
    out.box((x + 1.4, y + 1.2, z + 2.4), (x + 2.6, y + 1.5, z + 2.45))


def add_office(out, x, y, z, name, books):
    """One office; its own slab below, walls left, behind and a facade in front, which is where y is least."""
    clear = HEIGHT - SLAB
    out.begin(f"{name}-slab", "concrete")
    out.box((x, y, z - SLAB), (x + WIDTH, y + DEPTH, z))
    out.begin(f"{name}-walls", "plaster")
    out.box((x, y + WALL, z), (x + WALL / 2, y + DEPTH, z + clear))
    out.box((x + WIDTH - WALL / 2, y + WALL, z), (x + WIDTH, y + DEPTH, z + clear))
    out.box((x + WALL / 2, y + DEPTH - WALL, z), (x + 2.4, y + DEPTH, z + clear))  # beside it the door stands open
    out.box((x + 3.3, y + DEPTH - WALL, z), (x + WIDTH - WALL / 2, y + DEPTH, z + clear))
    out.facade((x, y, z), (WIDTH, WALL, clear), (x + 0.8, z + 0.9), (x + WIDTH - 0.8, z + 2.4))
    out.begin(f"{name}-window", "glass")
    out.mesh([(x + 0.8, y + 0.1, z + 0.9), (x + WIDTH - 0.8, y + 0.1, z + 0.9),
              (x + WIDTH - 0.8, y + 0.1, z + 2.4), (x + 0.8, y + 0.1, z + 2.4)], ((0, 1, 2, 3),))
    add_furniture(out, x, y, z, name)
    out.begin(f"{name}-books", "book")
    add_books(out, (x + 2.8, y + 4.4, z), 0, books)


def add_papers(out, origin, count):
    x, y, z = origin
    for i in range(count):
        left, low = x + 0.1 * i, z + 0.001
        out.mesh([(left, y, low), (left + 0.08, y, low), (left, y + 0.1, low)], ((0, 1, 2),))


def office_triangles(books):
    class Counter:
        triangles = 0

        def write(self, _):
            pass

        def writelines(self, lines):
            for _ in lines:
                pass
    out = Writer(Counter())
    add_office(out, 0.0, 0.0, 0.0, "office", books)
    return out.triangles


def place_of(office, side):
    """Origin of the office of this number; the block is `side` houses wide."""
    house, inside = divmod(office, STOREYS * OFFICES_A_STOREY)
    storey, place = divmod(inside, OFFICES_A_STOREY)
    row, column = divmod(house, side)
    return (column * (OFFICES_A_STOREY * WIDTH + STREET) + place * WIDTH, row * (DEPTH + STREET), storey * HEIGHT)


def write_block(out, triangles, books_an_office=60):
    per_office = office_triangles(books_an_office)
    bare = office_triangles(0)
    offices = max(1, triangles // per_office)
    if triangles < bare:
        sys.exit(f"city_block: an office alone has {bare} triangles; ask for as many at least")
    books = min(books_an_office, (triangles // offices - bare) // BOX_TRIANGLES)
    missing = triangles - offices * (bare + BOX_TRIANGLES * books)
    side = max(1, math.isqrt(max(0, offices - 1) // (STOREYS * OFFICES_A_STOREY)) + 1)
    for office in range(offices):
        x, y, z = place_of(office, side)
        extra = missing // BOX_TRIANGLES // offices + (office < missing // BOX_TRIANGLES % offices)
        add_office(out, x, y, z, f"office{office}", books + extra)
    if missing % BOX_TRIANGLES:
        out.begin("papers", "paper")
        add_papers(out, (x + 1.3, y + 1.3, z + 0.75), missing % BOX_TRIANGLES)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("triangles", type=int, help="how many the file shall have")
    parser.add_argument("-o", "--out", type=Path, required=True, help="the OBJ file; its MTL file is written beside it")
    arguments = parser.parse_args()
    mtl = arguments.out.with_suffix(".mtl")
    mtl.write_text("".join(f"newmtl {name}\nKd {c} {c} {c}\n" for name, c in MATERIALS.items()))
    with arguments.out.open("w") as file:
        file.write(f"# city block of furnished offices, metres, z up\nmtllib {mtl.name}\n")
        out = Writer(file)
        write_block(out, arguments.triangles)
    assert out.triangles == arguments.triangles, (out.triangles, arguments.triangles)


if __name__ == "__main__":
    main()
