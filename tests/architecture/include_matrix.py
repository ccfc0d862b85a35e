#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints who includes whom between the folders, and fails on

- an arrow back: includes go tools → io → lighting → mesh, and no other way;
- a heavy library in a header, or outside the folder that owns it;
- a source file that does not open with its SPDX line.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LAYERS = ["mesh", "lighting", "io", "tools"]  # each may include itself and those before it
OTHERS = ["tests", "benchmarks"]
SPDX = "// SPDX-License-Identifier: GPL-3.0-or-later"

# Library → (pattern of its includes, the folder that owns it).
HEAVY = {
    "CGAL": (r"CGAL/", "mesh"),
    "Embree": (r"embree3/", "mesh"),
    "OpenSubdiv": (r"opensubdiv/", "mesh"),
    "TBB": (r"(oneapi/)?tbb(/|\.h)", "lighting"),
    "assimp": (r"assimp/", "io"),
    "IfcPlusPlus": (r"ifcpp/|Ifc\w+\.h", "io"),
    "expat": (r"expat\w*\.h", "io"),
    "VTK": (r"vtk\w*\.h", "io"),
    "toml++": (r"toml(\+\+|plusplus)|toml\.hpp", "io"),
    "nlohmann": (r"nlohmann/", "io"),
    "CLI11": (r"CLI/", "tools"),
}

# Private headers, included from .cpp files of their own folder and its tests alone, that may name a heavy library.
PRIVATE_HEADERS = {
    "io/assimp_import.h",  # the steps of one import hand on the importer's own scene
    "io/assimp_materials.h",
    "io/assimp_model.h",
    "io/ifc_entities.h",  # likewise the parser's entities
    "io/ifc_quantities.h",
    "io/ifc_shapes.h",
    "io/ifc_styles.h",
    "io/lighting_json.h",
    "io/report_json.h",  # what summary, inspect and clean say in the same words
    "lighting/parallel.h",  # the one door to threads
}


def sources(folder):
    return sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in (".h", ".cpp"))


def includes(path):
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE)


def folder_of(name):
    return name.split("/")[0]


def heavy_complaints(name, included):
    """What is wrong with the heavy libraries that the file names."""
    for library, (pattern, owner) in HEAVY.items():
        if not re.match(pattern, included):
            continue
        if folder_of(name) != owner and folder_of(name) not in OTHERS:
            yield f"{name} includes {included}: {library} belongs to {owner}/"
        if name.endswith(".h") and name not in PRIVATE_HEADERS:
            yield f"{name} includes {included}: {library} may stand in .cpp files and named private headers alone"


def private_complaints(name, included):
    own = name.removeprefix("tests/")  # a folder's tests are its own
    if included in PRIVATE_HEADERS and folder_of(included) != folder_of(own):
        yield f"{name} includes {included}, which is private to {folder_of(included)}/"
    if included in PRIVATE_HEADERS and name.endswith(".h") and name not in PRIVATE_HEADERS:
        yield f"{name} includes {included}, which is for .cpp files"


def layer_complaints(name, included):
    if folder_of(name) in OTHERS:
        return
    if folder_of(included) in OTHERS and "/" in included:
        yield f"{name} includes {included}: the program knows nothing of its tests"
    if folder_of(included) in LAYERS and LAYERS.index(folder_of(included)) > LAYERS.index(folder_of(name)):
        yield f"{name} includes {included}: an arrow back"


def print_matrix(counts):
    print("includes of →".ljust(14) + "".join(layer.rjust(10) for layer in LAYERS))
    for row in LAYERS[::-1] + OTHERS:
        print(row.ljust(14) + "".join(str(counts.get((row, column)) or "·").rjust(10) for column in LAYERS))


def main():
    counts, complaints = {}, []
    for path in (p for folder in LAYERS + OTHERS for p in sources(folder)):
        name = path.relative_to(ROOT).as_posix()
        if path.read_text(encoding="utf-8").split("\n", 1)[0].strip() != SPDX:
            complaints.append(f"{name}: the first line is not {SPDX}")
        for included in includes(path):
            if "/" in included and folder_of(included) in LAYERS:
                key = (folder_of(name), folder_of(included))
                counts[key] = counts.get(key, 0) + 1
            complaints += [*layer_complaints(name, included), *heavy_complaints(name, included),
                           *private_complaints(name, included)]
    print_matrix(counts)
    print("\n".join(complaints))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
