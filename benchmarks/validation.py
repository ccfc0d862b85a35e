#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers the reference scenes as a user would and compares them with their references.

    benchmarks/validation.py [--program build/release/clerestory] [--repeat 5] [SCENE ...]

Prints for each scene the accuracy asked, the CPU time (user + system of the whole process at one thread, the median of --repeat
runs), and what tools/compare.py beside the references says. The machine's incoherent rtcOccluded1 rays a CPU second, measured in the same
minute by rays_benchmark, stand above the table where that program is built: limits on CPU time hold for 9 million."""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
VALIDATION = Path(os.environ.get("CLERESTORY_VALIDATION_DIR") or ROOT.parent / "shared" / "validation").resolve()
SCENES = {  # name: (subcommand, accuracy asked)
    "office": ("daylight", 0.02),
    "lamp-room": ("illuminance", 0.01),
    "atrium": ("daylight", 0.05),
}


def material_keys(values):
    if values["type"] == "glass":
        return f"glazing = {{ transmittance = {values['tau_normal']}, panes = 1 }}\n"
    text = f"reflectance = {values['reflectance']}\n"
    if values["type"] == "emitter":
        text += f"emission = {{ flux_lm = {values['flux_lm']} }}\n"
    return text


def study_text(name):
    scene = VALIDATION / name
    materials = json.loads((scene / "materials.json").read_text())
    sky = "none" if any(m["type"] == "emitter" for m in materials.values()) else "cie-overcast"
    text = f"[model]\nfile = '{scene / 'scene.obj'}'\nunits = \"m\"\n"
    text += "".join(f'[materials."{m}"]\n{material_keys(values)}' for m, values in materials.items())
    text += f'[sky]\ntype = "{sky}"\nhorizontal_illuminance = 10000.0\nground_reflectance = 0.2\n'
    return text + f"[[grids]]\nname = \"workplane\"\npoints = '{scene / 'sensors.pts'}'\n"


def cpu_seconds(command):
    """User + system time of one run, and its exit status."""
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        message = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 4):  # 4: accuracy not reached, results written
        sys.exit(f"{' '.join(map(str, command))}: exit status {process.returncode}\n{message}")
    return usage.ru_utime + usage.ru_stime, process.returncode


def rays_per_second(program):
    """The machine's figure, in millions; None where the benchmark is not built."""
    benchmark = program.parent / "benchmarks" / "rays_benchmark"
    if not benchmark.is_file():
        return None
    out = subprocess.run([benchmark, "--benchmark_filter=^occluded$", "--benchmark_format=json"], check=True,
                         capture_output=True, text=True).stdout
    return json.loads(out)["benchmarks"][0]["items_per_second"] / 1e6


class SceneRun(NamedTuple):
    cpu_s: float     # user and system, median of the runs
    comparison: str  # with the reference, as compare.py prints it
    met: bool        # whether the program says that it reached the accuracy asked


def run_scene(program, name, repeat, folder, accuracy=None):
    """Runs a scene as a user would, at one thread, and compares its sensors with the reference."""
    subcommand, usual = SCENES[name]
    study = folder / f"{name}.toml"
    study.write_text(study_text(name))
    results = folder / name
    command = [program, subcommand, study, "-o", results, "--accuracy", str(accuracy or usual), "--threads", "1", "--quiet"]
    runs = [cpu_seconds(command) for _ in range(repeat)]
    compare = subprocess.run([sys.executable, VALIDATION.parent / "tools" / "compare.py", results / "workplane.csv",
                              VALIDATION / name / "reference.csv"], check=True, capture_output=True, text=True).stdout
    return SceneRun(statistics.median(t for t, _ in runs), compare.strip(), runs[0][1] == 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "release" / "clerestory")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="runs a scene; the median time counts")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=", ".join(SCENES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.scenes if name not in SCENES]
    if unknown:
        parser.error(f"no scene {unknown[0]}; there are {', '.join(SCENES)}")
    if not VALIDATION.is_dir():
        sys.exit(f"no reference scenes in {VALIDATION}; set CLERESTORY_VALIDATION_DIR")
    rays = rays_per_second(arguments.program.resolve())
    print("rays a CPU second: " + (f"{rays:.1f} million" if rays else "unknown (build the target benchmarks)"), flush=True)
    print("scene    accuracy   CPU time   against the reference")
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.scenes or SCENES:
            run = run_scene(arguments.program.resolve(), name, arguments.repeat, Path(folder))
            met = "" if run.met else " (accuracy not reached)"
            print(f"{name:10} {100 * SCENES[name][1]:4.1f} %{run.cpu_s:9.2f} s   {run.comparison}{met}", flush=True)


if __name__ == "__main__":
    main()
