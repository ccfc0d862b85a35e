#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the VTK files of a results folder with VTK's own readers, and checks arrays, counts and ranges.

    read_back.py RESULTS

Exit status: 0 all is well, 1 something is wrong (a line each), 77 VTK's Python modules are missing.
"""
import csv
import json
import math
import sys
from pathlib import Path

try:
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLPolyDataReader
except ImportError:
    print("VTK's Python modules are missing (python3-vtk9)")
    sys.exit(77)

SURFACE_ARRAYS = ["illuminance_lux", "error_lux", "radiosity_lm_m2", "luminance_cd_m2", "reflectance", "side",
                  "level", "part", "material", "room"]
FIELD_WORDS = ["units", "sky", "version"]

complaints = []


def expect(condition, message):
    if not condition:
        complaints.append(message)
    return condition


def read_polygons(path):
    reader = vtkXMLPolyDataReader()
    expect(reader.CanReadFile(str(path)) == 1, f"{path.name}: no VTK XML polygons")
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def values(attributes, name, count, where):
    array = attributes.GetArray(name)
    if not expect(array is not None, f"{where}: no array {name}"):
        return [0.0] * count
    expect(array.GetNumberOfTuples() == count, f"{where}: {name} has {array.GetNumberOfTuples()} values, not {count}")
    return [array.GetTuple1(i) for i in range(array.GetNumberOfTuples())]


def expect_light(numbers, where):
    expect(all(math.isfinite(v) and v >= 0.0 for v in numbers), f"{where}: not finite or below zero")


def words(data, name, where):
    array = data.GetFieldData().GetAbstractArray(name)
    if not expect(array is not None, f"{where}: no field array {name}"):
        return []
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def check_field_data(data, summary, where):
    for name in FIELD_WORDS:
        expect(any(words(data, name, where)), f"{where}: {name} says nothing")
    expect(any("illuminance_lux" in unit for unit in words(data, "units", where)), f"{where}: no unit of illuminance")
    if "version" in summary:
        expect(words(data, "version", where) == [summary["version"]], f"{where}: not the version of summary.json")


def check_grid(folder, name, summary):
    where = f"{name}.vtp"
    data = read_polygons(folder / where)
    with open(folder / f"{name}.csv", newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    count = data.GetNumberOfCells()
    expect(count == len(rows) > 0, f"{where}: {count} cells, {len(rows)} lines in {name}.csv")
    columns = [c for c in ("id", "illuminance_lux", "error_lux", "daylight_factor_percent") if c in rows[0]]
    for column in columns:
        found = values(data.GetCellData(), column, len(rows), where)
        expect_light(found, f"{where}: {column}")
        for row, value in zip(rows, found):
            if not expect(math.isclose(float(row[column]), value, rel_tol=1e-6, abs_tol=1e-9),
                          f"{where}: {column} of sensor {row['id']} is {value}, {row[column]} in the table"):
                break
    for i, row in enumerate(rows):
        bounds = data.GetCell(i).GetBounds()
        place = [float(row[c]) for c in "xyz"]
        if not expect(all(bounds[2 * k] - 1e-5 <= place[k] <= bounds[2 * k + 1] + 1e-5 for k in range(3)),
                      f"{where}: cell {i} does not hold its sensor"):
            break
    check_field_data(data, summary, where)
    return count


def check_indices(numbers, names, lowest, where):
    expect(all(v == int(v) and lowest <= v < len(names) for v in numbers), f"{where}: indices beyond {len(names)} names")


def check_surfaces(folder, summary):
    where = "surfaces.vtp"
    data = read_polygons(folder / where)
    count = data.GetNumberOfPolys()
    expect(count > 0 and count == data.GetNumberOfCells(), f"{where}: {count} polygons of {data.GetNumberOfCells()} cells")
    cells = {name: values(data.GetCellData(), name, count, where) for name in SURFACE_ARRAYS}
    for name in SURFACE_ARRAYS[:7]:
        expect_light(cells[name], f"{where}: {name}")
    points = values(data.GetPointData(), "illuminance_lux", data.GetNumberOfPoints(), where)
    expect_light(points, f"{where}: illuminance_lux at points")
    expect(set(cells["side"]) <= {0.0, 1.0}, f"{where}: sides other than 0 and 1")
    expect(all(v <= 1.0 for v in cells["reflectance"]), f"{where}: reflectance above 1")
    expect(all(v == int(v) for v in cells["level"]), f"{where}: levels are not whole")
    expect(all(math.isclose(math.pi * l, b, rel_tol=1e-3, abs_tol=1e-6)
               for l, b in zip(cells["luminance_cd_m2"], cells["radiosity_lm_m2"])),
           f"{where}: luminance is not radiosity / pi")
    check_indices(cells["part"], words(data, "part_names", where), 0, f"{where}: part")
    check_indices(cells["material"], words(data, "material_names", where), 0, f"{where}: material")
    check_indices(cells["room"], words(data, "room_names", where), -1, f"{where}: room")
    check_field_data(data, summary, where)
    return count


def check_lines(folder):
    where = "discontinuities.vtp"
    data = read_polygons(folder / where)
    count = data.GetNumberOfLines()
    expect(count > 0 and count == data.GetNumberOfCells(), f"{where}: {count} lines of {data.GetNumberOfCells()} cells")
    orders = values(data.GetCellData(), "order", count, where)
    expect(set(orders) <= {0.0, 1.0, 2.0}, f"{where}: orders {set(orders)}")
    for name in ("source", "occluder"):
        expect(data.GetCellData().GetAbstractArray(name) is not None, f"{where}: no array {name}")
    return count


def check_collection(folder, counts):
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(folder / "result.vtm"))
    reader.Update()
    blocks = reader.GetOutput()
    expect(blocks.GetNumberOfBlocks() == len(counts), f"result.vtm: {blocks.GetNumberOfBlocks()} blocks, not {len(counts)}")
    found = {}
    for i in range(blocks.GetNumberOfBlocks()):
        block = blocks.GetBlock(i)
        name = blocks.GetMetaData(i).Get(vtkCompositeDataSet.NAME())
        found[name] = block.GetNumberOfCells() if block else 0
    expect(found == counts, f"result.vtm: blocks {found}, files {counts}")


def main():
    folder = Path(sys.argv[1])
    with open(folder / "summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    grids = sorted(path.stem for path in folder.glob("*.csv"))
    expect(grids, f"{folder}: no grid")
    counts = {name: check_grid(folder, name, summary) for name in grids}
    counts["surfaces"] = check_surfaces(folder, summary)
    if "discontinuities.vtp" in summary["files"]:
        counts["discontinuities"] = check_lines(folder)
    check_collection(folder, counts)
    print("\n".join(complaints) or f"{folder.name}: cells {counts}")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
