#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Promises of the command that take more than one run of it, a signal, or a limit: scenarios.py SCENARIO --program P
--scratch DIR. A scenario is a function below; its name is the promise."""
import argparse
import json
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

INPUTS = Path(__file__).resolve().parent / "inputs"
CITY_BLOCK = Path(__file__).resolve().parents[2] / "benchmarks" / "city_block.py"
RESULTS = {"summary.json", "result.vtm", "surfaces.vtp", "discontinuities.vtp", "workplane.csv", "workplane.png",
           "workplane.vtp"}


class Command:
    """Runs the command in the scratch folder, which holds the room and its study."""

    def __init__(self, program, scratch):
        self.program, self.scratch = program, scratch
        shutil.rmtree(scratch, ignore_errors=True)
        scratch.mkdir(parents=True)
        for name in ("room.toml", "room.obj"):
            shutil.copy(INPUTS / name, scratch)

    def start(self, *arguments, prepare=None, folder="."):
        return subprocess.Popen([self.program, *arguments], cwd=self.scratch / folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=prepare)

    def run(self, *arguments, status=0, lines=0, **how):
        """Runs to the end; stderr, which must have so many lines."""
        process = self.start(*arguments, **how)
        _, err = process.communicate()
        expect(process.returncode == status, f"{arguments}: status {process.returncode}, not {status}: {err}")
        expect(len(err.splitlines()) == lines, f"{arguments}: stderr is not {lines} lines: {err!r}")
        return err

    def contents(self, folder="."):
        root = self.scratch / folder
        return {str(p.relative_to(root)): p.read_bytes() for p in sorted(root.rglob("*")) if p.is_file()}


def expect(fact, otherwise):
    if not fact:
        sys.exit(otherwise)


def limit_file_size(size):
    """A full disk for those who cannot mount one: no file may grow beyond the size [bytes]."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def current_folder_keeps_other_files(command):
    (command.scratch / "thesis.doc").write_text("years of work")
    command.run("daylight", "room.toml", "-o", ".", "--quiet")
    command.run("daylight", "room.toml", "-o", ".", "--quiet")
    after = command.contents()
    expect(set(after) == RESULTS | {"room.toml", "room.obj", "thesis.doc"}, f"there are {sorted(after)}")
    expect(after["thesis.doc"] == b"years of work", "thesis.doc has changed")


def file_of_the_user_is_not_overwritten(command):
    (command.scratch / "workplane.csv").write_text("mine")
    before = command.contents()
    err = command.run("daylight", "room.toml", "-o", ".", status=1, lines=1)
    expect("workplane.csv" in err and "-o" in err, f"no remedy: {err}")
    expect(command.contents() == before, "something has changed")


def second_run_replaces_the_first(command):
    command.run("daylight", "room.toml", "--quiet")
    study = command.scratch / "room.toml"
    study.write_text(study.read_text().replace('"workplane"', '"desk"'))
    command.run("daylight", "room.toml", "--quiet")
    names = set(command.contents("room-results"))
    expect(names == {n.replace("workplane", "desk") for n in RESULTS}, f"there are {sorted(names)}")


def full_disk_writes_nothing(command):
    before = command.contents()
    err = command.run("daylight", "room.toml", status=3, lines=1, prepare=limit_file_size(100))
    expect("room-results" in err, f"the folder is not named: {err}")
    expect(command.contents() == before and not (command.scratch / "room-results").exists(), "something was written")


def full_disk_keeps_older_results(command):
    command.run("daylight", "room.toml", "--quiet")
    older = command.contents("room-results")
    limit = max(10_000, min(20_000, len(older["workplane.png"]) - 1))  # enough for the check before the run
    command.run("daylight", "room.toml", status=3, lines=1, prepare=limit_file_size(limit))
    after = command.contents("room-results")
    expect(json.loads(after.pop("summary.json"))["status"] == "failed", "the failure is not recorded")
    expect(after == {f"previous/{name}": data for name, data in older.items()}, f"there are {sorted(after)}")


def clean_on_a_full_disk_leaves_what_was_there(command):
    command.run("clean", "room.obj", "-o", "clean.obj", "--quiet")
    before = command.contents()
    err = command.run("clean", "room.obj", "-o", "clean.obj", "--gap", "0.001", status=3, lines=1,
                      prepare=limit_file_size(1000))
    expect("-o" in err and "writing" not in err, f"no remedy: {err}")
    expect(command.contents() == before, "something has changed")


def clean_replaces_its_own_files_alone(command):
    command.run("clean", "room.obj", "-o", "clean.obj", "--quiet")
    first = command.contents()
    command.run("clean", "room.obj", "-o", "clean.obj", "--quiet")
    expect(command.contents() == first, "the same model is not the same")
    (command.scratch / "other.mtl").write_text("mine")
    before = command.contents()
    err = command.run("clean", "room.obj", "-o", "other.obj", status=1, lines=1)
    expect("other.mtl" in err and "-o" in err, f"no remedy: {err}")
    expect(command.contents() == before, "something has changed")


def interruption_leaves_the_folder_as_it_was(command):
    command.run("daylight", "room.toml", "--quiet")
    before = command.contents()
    for stop in (signal.SIGINT, signal.SIGTERM):
        process = command.start("daylight", "room.toml", "--set", "grids.0.spacing=0.02", "--accuracy", "0.2%")
        time.sleep(1.0)
        expect(process.poll() is None, "the run ended too soon to be interrupted")
        process.send_signal(stop)
        asked = time.monotonic()
        _, err = process.communicate(timeout=60)
        expect(process.returncode == 130, f"status {process.returncode}: {err}")
        expect(err == "error: interrupted\n", f"stderr is {err!r}")
        expect(time.monotonic() - asked < 20.0, "it took too long to stop")
        expect(command.contents() == before, "something has changed")


def interruption_keeps_what_there_is_when_asked(command):
    process = command.start("daylight", "room.toml", "--set", "grids.0.spacing=0.02", "--accuracy", "0.2%",
                            "--keep-partial")
    time.sleep(2.0)  # the clean-up takes a tenth of a second
    expect(process.poll() is None, "the run ended too soon to be interrupted")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    expect(process.returncode == 130, f"status {process.returncode}: {err}")
    expect(err.startswith("error: stopped by interruption in the phase") and "stopped   by interruption" in out, err)
    expect(set(command.contents("room-results")) >= RESULTS - {"discontinuities.vtp"}, "results are missing")
    summary = json.loads(command.contents("room-results")["summary.json"])
    expect(summary["status"] == "partial" and summary["stopped"]["by"] == "interruption", f"it says {summary}")


def limit_on_time_ends_with_what_there_is(command):
    begin = time.monotonic()
    err = command.run("daylight", "room.toml", "--quiet", "--set", "grids.0.spacing=0.02", "--accuracy", "0.2%",
                      "--max-time", "2s", status=4, lines=1)
    expect(time.monotonic() - begin < 20.0, "it took too long")
    expect(err.startswith("error: stopped by time in the phase"), err)
    summary = json.loads(command.contents("room-results")["summary.json"])
    expect(summary["status"] == "accuracy-not-reached" and summary["stopped"]["by"] == "time", f"it says {summary}")


def limit_on_time_holds_for_a_block_of_offices(command):
    """Far less than the run takes; where it ends depends on the machine, that it ends there and says so does not."""
    subprocess.run([sys.executable, CITY_BLOCK, "20000", "-o", command.scratch / "block.obj"], check=True)
    (command.scratch / "block.toml").write_text('[model]\nfile = "block.obj"\nunits = "m"\n[[grids]]\nname = "workplane"\n'
                                                'points = "eyes.pts"\n')
    (command.scratch / "eyes.pts").write_text("1 1 0.8 0 0 1\n3 4 0.8 0 0 1\n")
    err = command.run("daylight", "block.toml", "--quiet", "--accuracy", "0.5%", "--max-time", "1s", status=4, lines=1)
    expect("--max-time" in err or "stopped by time" in err, f"the limit is not named: {err}")
    summary = json.loads(command.contents("block-results")["summary.json"])
    expect(summary["status"] in ("failed", "partial", "accuracy-not-reached"), f"it says {summary}")
    expect(summary["status"] == "failed" or summary["stopped"]["by"] == "time", f"it says {summary}")


def elements_that_are_used_up_are_reported(command):
    budget = ("--set", "mesh.max_elements=1000")
    err = command.run("daylight", "room.toml", "--quiet", "--accuracy", "0.1%", *budget, status=4,
                      lines=1)
    expect(err.startswith("error: stopped by elements in the phase"), err)
    summary = json.loads(command.contents("room-results")["summary.json"])
    expect(summary["status"] == "accuracy-not-reached" and summary["stopped"]["by"] == "elements", f"it says {summary}")
    expect(summary["counts"]["elements"] <= 1000, f"it says {summary}")
    command.run("daylight", "room.toml", "--quiet", "--accuracy", "1%", *budget)
    summary = json.loads(command.contents("room-results")["summary.json"])
    expect(summary["status"] == "done" and summary["stopped"]["by"] == "elements", f"it says {summary}")
    command.run("daylight", "room.toml", "--quiet", *budget)
    expect(json.loads(command.contents("room-results")["summary.json"])["stopped"] is None, "nothing was to be stopped")


def limit_met_with_nothing_to_show_leaves_nothing_stale(command):
    command.run("daylight", "room.toml", "--quiet")
    older = command.contents("room-results")
    for limit in (("--max-time", "0.001s"), ("--max-memory", "1MB")):
        err = command.run("daylight", "room.toml", *limit, status=4, lines=1)
        expect(limit[0] in err and "to show" in err, f"no remedy: {err}")
        after = command.contents("room-results")
        expect(json.loads(after.pop("summary.json"))["status"] == "failed", "the failure is not recorded")
        expect(after == {f"previous/{name}": data for name, data in older.items()}, f"there are {sorted(after)}")


def memory_that_runs_out_is_an_error_and_leaves_nothing_stale(command):
    command.run("daylight", "room.toml", "--quiet")
    older = command.contents("room-results")
    # Enough to start and to read the study, too little to solve it.
    err = command.run("daylight", "room.toml", "--set", "grids.0.spacing=0.003", status=3, lines=1,
                      prepare=lambda: resource.setrlimit(resource.RLIMIT_DATA, (150 << 20, 150 << 20)))
    expect("memory" in err, f"the reason is not named: {err}")
    after = command.contents("room-results")
    expect(json.loads(after.pop("summary.json"))["status"] == "failed", "the failure is not recorded")
    expect(after == {f"previous/{name}": data for name, data in older.items()}, f"there are {sorted(after)}")


def lines_of_two_gigabytes_are_refused_at_once(command):
    begin = {"obj": b"v ", "mtl": b"newmtl ", "stl": b"solid ", "ply": b"ply\nformat ascii 1.0\ncomment ", "off": b"OFF\n",
             "dxf": b"0\n", "rad": b"void plastic ", "gltf": b"{", "dae": b"<?xml version=", "ifc": b"ISO-10303-21;",
             "toml": b"[model] # ", "sdf": b"<sdf "}
    for ending, first in begin.items():
        file = command.scratch / f"long.{ending}"
        with file.open("wb") as out:
            out.write(first)
            for _ in range(65):
                out.write(b"9" * (1 << 20))
            out.truncate(1 << 31)  # what follows takes no place on the disk
        if ending == "mtl":
            (command.scratch / "model.obj").write_text("mtllib long.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        command.run("inspect", "model.obj" if ending == "mtl" else file.name, status=1, lines=1)
        file.unlink()
    # 64 MiB of a line, held several times at most, and not the file.
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    expect(peak < 600, f"it took {peak:.0f} MB")


def same_bytes_for_one_and_two_threads(command):
    tables = []
    for threads in ("1", "2"):
        command.run("daylight", "room.toml", "--quiet", "--threads", threads, "-o", threads)
        tables.append((command.scratch / threads / "workplane.csv").read_bytes())
    expect(tables[0] == tables[1], "the tables differ")


def stored_solution_answers_new_grids_and_no_other_study(command):
    command.run("daylight", "room.toml", "--quiet", "--save-solution")
    solved = command.contents("room-results")
    command.run("sense", "room-results", "--quiet")
    sensed = command.contents("room-results-sense")
    expect(sensed["workplane.csv"] == solved["workplane.csv"], "the same grid differs")
    expect("surfaces.vtp" not in sensed and "solution.h5" not in sensed, f"there are {sorted(sensed)}")
    command.run("sense", "room-results/solution.h5", "--quiet", "-o", "eyes", "--grid",
                'name = "eyes", surface = "rooms", height = 1.2')
    expect("eyes.csv" in command.contents("eyes"), "the new grid is missing")
    for arguments, status, why in (
            (("-o", "room-results"), 1, "would replace"), (("--set", "materials.glass.glazing.transmittance=0.4"), 1, "have changed"),
            (("--grid", 'nam = "eyes"'), 2, "did you mean 'name'")):
        expect(why in command.run("sense", "room-results", *arguments, status=status, lines=1), f"not told: {why}")
    command.run("sense", "room-results", "--quiet", "-o", "bright", "--set", "materials.wall.reflectance=0.8")
    mean = [sum(float(line.split(",")[7]) for line in table.decode().split()[1:])
            for table in (solved["workplane.csv"], command.contents("bright")["workplane.csv"])]
    expect(mean[1] > 1.1 * mean[0], f"brighter walls give {mean[1]} after {mean[0]}")
    expect("--save-solution" in command.run("sense", "eyes", status=1, lines=1), "no remedy")
    expect("run the study" in command.run("sense", "room-results", "--accuracy", "0.05%", "--quiet", "-o", "fine", status=4, lines=1),
           "no remedy for a solution too coarse")
    expect(command.contents("room-results") == solved, "the solved results have changed")
    command.run("daylight", "room.toml", "--quiet")
    expect("solution.h5" not in command.contents("room-results"), "a stale solution is left")


SCENARIOS = {f.__name__: f for f in (
    clean_on_a_full_disk_leaves_what_was_there, clean_replaces_its_own_files_alone, current_folder_keeps_other_files,
    elements_that_are_used_up_are_reported, file_of_the_user_is_not_overwritten, full_disk_keeps_older_results,
    full_disk_writes_nothing,
    interruption_keeps_what_there_is_when_asked, interruption_leaves_the_folder_as_it_was,
    limit_met_with_nothing_to_show_leaves_nothing_stale, limit_on_time_ends_with_what_there_is,
    limit_on_time_holds_for_a_block_of_offices,
    lines_of_two_gigabytes_are_refused_at_once, memory_that_runs_out_is_an_error_and_leaves_nothing_stale,
    same_bytes_for_one_and_two_threads, second_run_replaces_the_first,
    stored_solution_answers_new_grids_and_no_other_study)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("scenario", choices=SCENARIOS)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--scratch", type=Path, required=True)
    options = parser.parse_args()
    SCENARIOS[options.scenario](Command(options.program.resolve(), options.scratch.resolve()))


if __name__ == "__main__":
    main()
