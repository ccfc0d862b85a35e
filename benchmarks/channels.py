#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What channels cost: answers a reference scene with all light as one, and told apart in source groups.

    benchmarks/channels.py [--program build/release/clerestory] [--repeat 5] [SCENE]

CPU seconds of the whole command at one thread, the median of --repeat runs, the kinds of run by turns since machines drift; the ratio to
all light as one; and how far the sum of the columns is off the illuminance of all light."""
import argparse
import csv
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

import validation

COLUMNS = ("mix", "groups", "sky-145", "sky-577")


def run(program, scene, columns, folder):
    """The phases' CPU seconds, and the sensors as rows of numbers."""
    study = folder / f"{scene}.toml"
    study.write_text(validation.study_text(scene))
    results = folder / columns
    subcommand, accuracy = validation.SCENES[scene]
    subprocess.run([program, subcommand, study, "-o", results, "--accuracy", str(accuracy), "--threads", "1", "--quiet",
                    "--set", f'results.columns="{columns}"'], check=True)
    summary = json.loads((results / "summary.json").read_text())
    with open(results / "workplane.csv", newline="") as file:
        return summary["cpu_seconds"], list(csv.DictReader(file))


def differences(sensors):
    """Of the sum of the columns from all light, as shares of it, in order."""
    names = [name for name in sensors[0] if name.startswith("illuminance_lux_")]
    return len(names), sorted(abs(sum(float(s[n]) for n in names) / float(s["illuminance_lux"]) - 1)
                              for s in sensors if names and float(s["illuminance_lux"]) > 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", type=Path, default=validation.ROOT / "build" / "release" / "clerestory")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="runs a kind; the median time counts")
    parser.add_argument("scene", nargs="?", default="office", choices=validation.SCENES)
    arguments = parser.parse_args()
    times = {columns: [] for columns in COLUMNS}
    sensors = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(arguments.repeat):
            for columns in COLUMNS:
                cpu, sensors[columns] = run(arguments.program.resolve(), arguments.scene, columns, Path(folder))
                times[columns].append(cpu)
    print("columns   groups   channels s   gathering s   whole run s   ratio   sum off by, median and most")
    whole = {columns: statistics.median(cpu["total"] for cpu in times[columns]) for columns in COLUMNS}
    for columns in COLUMNS:
        median = {phase: statistics.median(cpu.get(phase, 0.0) for cpu in times[columns]) for phase in ("channels", "gathering")}
        count, off = differences(sensors[columns])
        sums = f"{100 * statistics.median(off):.3f} %  {100 * off[-1]:.3f} %" if off else ""
        print(f"{columns:9} {count:6} {median['channels']:12.3f} {median['gathering']:13.3f} {whole[columns]:13.2f} "
              f"{whole[columns] / whole['mix']:7.2f}   {sums}")


if __name__ == "__main__":
    main()
