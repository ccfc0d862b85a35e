#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes classroom.obj, classroom.mtl and panel.ldt beside this script: a classroom as a CAD tool exports one, and the luminaire that lights it.

Metres, z up, y north; the room is 0 ≤ x ≤ 9, 0 ≤ y ≤ 7, 0 ≤ z ≤ 3, the board hangs on the west wall, the windows look south."""
import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from parts import ObjFile, chair, legs, mtl_text, shell, window, window_wall  # noqa: E402

# Material: (diffuse reflectance as its colour in the MTL, opacity)
MATERIALS = {
    "floor": (0.25, 1.0), "ceiling": (0.80, 1.0), "wall": (0.60, 1.0), "board": (0.12, 1.0),
    "facade": (0.35, 1.0), "concrete": (0.30, 1.0), "frame": (0.60, 1.0), "glazing": (0.90, 0.3),
    "wood": (0.45, 1.0), "metal": (0.30, 1.0), "fabric": (0.35, 1.0), "obstruction": (0.30, 1.0), "ground": (0.20, 1.0),
}


def table(obj, name, x, y):
    """For two pupils, who look west."""
    obj.part(name)
    obj.box((x, y, 0.70), (x + 0.55, y + 1.3, 0.73), "wood")
    legs(obj, (x, y), (x + 0.55, y + 1.3), 0.04, 0.70, "metal")


def luminous_intensity(c_deg, gamma_deg):
    """Of a flat panel with a prismatic cover, downwards: wider across its length (C0) than along it (C90). Any unit."""
    gamma = math.radians(gamma_deg)
    across = math.cos(math.radians(c_deg)) ** 2
    return max(0.0, math.cos(gamma)) ** 1.4 * (1.0 + across * 0.9 * math.sin(gamma) ** 2)


def luminaire_text():
    """EULUMDAT, symmetric to both planes: 1.2 m x 0.3 m, 4000 lm, 32 W."""
    c_planes, gammas = range(0, 360, 15), range(0, 95, 5)
    quarter = [c for c in c_planes if c <= 90]
    ring = [0.5 if c in (0, 90) else 1.0 for c in quarter]
    flux = 0.0
    for a, b in zip(gammas, gammas[1:]):
        zone = 2 * math.pi * (math.cos(math.radians(a)) - math.cos(math.radians(b)))
        means = [0.5 * (luminous_intensity(c, a) + luminous_intensity(c, b)) for c in quarter]
        flux += zone * sum(w * m for w, m in zip(ring, means)) / sum(ring)
    per_kilolumen = 1000.0 / flux
    lines = ["Clerestory", "1", "4", str(len(c_planes)), "15", str(len(gammas)), "5", "none", "Panel 1200 x 300", "panel-1",
             "panel.ldt", "2026-11-22", "1200", "300", "60", "1180", "280", "0", "0", "0", "0", "100", "100", "1.0", "0",
             "1", "1", "LED", "4000", "4000 K", "80", "32"]
    lines += ["0"] * 10  # direct ratios: not stated
    lines += [str(c) for c in c_planes] + [str(g) for g in gammas]
    lines += [f"{per_kilolumen * luminous_intensity(c, g):.2f}" for c in quarter for g in gammas]
    return "\n".join(lines) + "\n"


def main():
    obj = ObjFile("classroom")
    windows, sill, head = [(0.7, 2.9), (3.4, 5.6), (6.1, 8.3)], 0.9, 2.6
    shell(obj, 9, 7)
    window_wall(obj, windows, sill, head, 9)
    for number, (x0, x1) in enumerate(windows, 1):
        window(obj, f"window_{number}", x0, x1, sill, head)
    for row in range(4):
        for column in range(3):
            number, x, y = 3 * row + column + 1, 2.6 + 1.6 * row, 0.9 + 2.0 * column
            table(obj, f"table_{number}", x, y)
            for place, at in (("a", y + 0.1), ("b", y + 0.75)):
                chair(obj, f"chair_{number}{place}", x + 0.6, at, x + 1.02)
    table(obj, "teachers_table", 1.1, 4.6)
    obj.part("board")
    obj.box((0, 1.7, 0.9), (0.03, 5.3, 2.1), "wood", east="board")
    obj.part("building_opposite")
    obj.box((-9, -32, -0.3), (18, -22, 8.7), "obstruction")
    (HERE / "classroom.obj").write_text(obj.text())
    (HERE / "classroom.mtl").write_text(mtl_text(MATERIALS))
    (HERE / "panel.ldt").write_text(luminaire_text())


if __name__ == "__main__":
    main()
