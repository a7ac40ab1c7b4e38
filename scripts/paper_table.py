#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes the six models of the paper's Table 1 and writes its table beside ours into docs/paper.md.

Each cloud is meshed by its file of launch_configs/reconstruct (the preset `paper`) and by default.cfg, on one thread,
`--repetitions` times; the counts are the same each time, and the fastest time of each step counts. A cloud that is absent is
named and leaves its rows empty; a program that fails ends the script with exit code 1.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/paper.md"
CONFIGS = ROOT / "launch_configs/reconstruct"
BEGIN, END = "<!-- table1 -->", "<!-- end -->"

# Table 1 as printed, but for the cat's last two counts, which are printed the other way round: points, representatives,
# triangles of three levels, seconds of four steps.
PAPER = {
    "cactus": (3337, 404, (782, 2776, 9614), (0.21, 1.58, 0.2, 0.68)),
    "cat": (10000, 1244, (2453, 8535, 29257), (0.77, 6.02, 0.61, 2.06)),
    "horse": (48482, 6164, (12046, 42860, 144828), (4.67, 30.83, 3.17, 10.76)),
    "dragon": (437645, 55694, (109889, 361455, 810367), (62.43, 297.8, 27.22, 58.98)),
    "bunny": (35933, 4457, (8895, 31623, 107363), (3.68, 22.48, 2.33, 7.9)),
    "club": (16864, 2103, (4121, 15037, 51775), (1.36, 5.3, 1.11, 3.86)),
}
CLOUDS = {
    "cactus": "cloud/cactus_3337.pcd",
    "cat": "cloud/cat_10000.pcd",
    "horse": "cloud/horse_48485.pcd",
    "dragon": "sampled/dragon_437645_standin.pcd",
    "bunny": "cloud/bunny_35947.pcd",
    "club": "cloud/club_16864.pcd",
}
STEPS = ("representatives", "triangulation", "refinement 1", "refinement 2")
OUTSIDE = ("read", "report", "write")  # stages that are in none of the steps


def step_of(stage):
    """The column that a stage of the program counts for; what comes before the triangulation makes the representatives."""
    if stage in OUTSIDE:
        return None
    return stage if stage in STEPS else "representatives"


def seconds(report):
    """Seconds of the four steps in a report of mlsmesh_reconstruct."""
    sums = dict.fromkeys(STEPS, 0.0)
    for stage in report["stages"]:
        step = step_of(stage["name"])
        if step is not None:
            sums[step] += stage["seconds"]
    return tuple(sums[step] for step in STEPS)


def run_reconstruct(options, cloud, mesh, more):
    """The report of mlsmesh_reconstruct on one thread, with the options `more`."""
    report = mesh.with_suffix(".json")
    command = [options.bin / "mlsmesh_reconstruct", cloud, mesh, "--threads", "1", "--quiet", "--json", report, *more]
    done = subprocess.run([str(part) for part in command], check=False)
    if done.returncode != 0:
        sys.exit(f"paper_table: exit code {done.returncode} from: {' '.join(map(str, command))}")
    return json.loads(report.read_text())


def reconstruct(options, cloud, config, folder):
    """(points, representatives, triangles, seconds) of a cloud meshed by a config file."""
    times = []
    for _ in range(options.repetitions):
        found = run_reconstruct(options, cloud, folder / "mesh.ply", ["--config", CONFIGS / config])
        times.append(seconds(found))
    triangles = tuple(level["triangles"] for level in found["levels"])
    return found["input"]["used"], found["representatives"], triangles, tuple(map(min, zip(*times)))


def row(name, by, counts):
    points, representatives, triangles, times = counts
    grown = [f"{fine / coarse:.2f}" for coarse, fine in zip(triangles, triangles[1:])]
    cells = [name, by, f"{points:,}", f"{representatives:,}", f"{points / representatives:.2f}"]
    cells += [f"{count:,}" for count in triangles] + [", ".join(grown)]
    cells += [f"{time:.2f}" if time >= 0.1 else f"{time:.3f}" for time in times]
    return "| " + " | ".join(cells) + " |"


def table(options):
    head = ["model", "by", "points", "representatives", "points each"]
    head += [f"triangles, level {level}" for level in range(3)] + ["growth"]
    head += ["s, clustering and reduction", "s, triangulation", "s, refinement 1", "s, refinement 2"]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    with tempfile.TemporaryDirectory() as work:
        for model, cloud in CLOUDS.items():
            lines.append(row(model, "the paper", PAPER[model]))
            file = options.data / cloud
            if not file.is_file():
                print(f"paper_table: SKIPPED: no {cloud} in {options.data}", file=sys.stderr)
                lines.append(f"| | not measured: no `{cloud}` |" + " |" * (len(head) - 2))
                continue
            for preset, config in (("`paper`", f"{model}.cfg"), ("`default`", "default.cfg")):
                lines.append(row("", preset, reconstruct(options, file, config, pathlib.Path(work))))
    return "\n".join(lines)


def arguments(description):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    data = os.environ.get("MLSMESH_DATA_DIR", ROOT.parent / "shared/data")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin", help="folder of the programs")
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path(data), help="folder of the clouds")
    parser.add_argument("--repetitions", type=int, default=3, help="runs of each cloud for Table 1, the fastest counts (3)")
    parser.add_argument("--print", action="store_true", help="print, and leave docs/paper.md as it is")
    options = parser.parse_args()
    if options.repetitions < 1:
        parser.error("--repetitions must be at least 1")
    return options


def write_between(begin, end, text, options):
    """Puts the text between two markers of docs/paper.md, or prints it."""
    if options.print:
        print(text)
        return
    page = PAGE.read_text()
    if page.count(begin) != 1 or page.count(end) != 1:
        sys.exit(f"{PAGE.name} must hold {begin} and {end} once each")
    before, rest = page.split(begin)
    PAGE.write_text(f"{before}{begin}\n{text}\n{end}{rest.split(end)[1]}")


def main():
    options = arguments(__doc__)
    write_between(BEGIN, END, table(options), options)


if __name__ == "__main__":
    main()
