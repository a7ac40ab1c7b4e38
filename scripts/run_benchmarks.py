#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the programs of bench/ and writes their figures as Markdown: ratios, times, memory, the command behind each.

A ratio is of the best of --repetitions runs of either side, taken in turn by one process on a cloud that it has read.
What cannot be measured because something is absent is named on standard error and in the report, never made up. The exit
code is 1 if a program that is there failed.
docs/benchmarks.md says what the figures are. Needs the build that -DMLSMESH_BUILD_BENCH=ON makes, and Linux.
"""

import argparse
import dataclasses
import os
import pathlib
import sys
import tempfile

import benchmark_report as report
from benchmark_clouds import Clouds, synthetic
from benchmark_rows import COMPARISONS, MEMORY_RUNS, STEP_POINTS, STEPS, Comparison
from benchmark_runs import REPEAT_FLAGS, Absent, Cloud, Disturbance, Failed, Programs, Timing, filter_of, peer_once, say

ROOT = pathlib.Path(__file__).resolve().parent.parent
SPECIAL = ("cgal", "threads", "size")
LARGE_REPETITIONS = 2


@dataclasses.dataclass
class Result:
    """Ratios of one comparison; None where they mean nothing."""

    comparison: Comparison
    cloud: str
    spread: float
    cpu: float = None
    wall: float = None
    two_threads: float = None
    two_threads_spread: float = None

    @property
    def reached(self):
        value = self.two_threads if self.cpu is None else self.cpu
        return value <= self.comparison.goal if self.comparison.at_most else value >= self.comparison.goal


def ratio(comparison, ours, theirs):
    return ours / theirs if comparison.at_most else theirs / ours


class Session:
    """One run of this script: what it found and what it had to leave out."""

    def __init__(self, options, work):
        self.options = options
        self.work = pathlib.Path(work)
        self.programs = Programs(options.bin, work, options.repetitions)
        self.clouds = Clouds(options, work, self.skip)
        self.two_threads = {}  # (cloud, benchmark) -> Timing
        self.results, self.times, self.memory, self.steps = [], [], [], None
        self.commands, self.skipped = [], []
        self.failed = False

    def skip(self, what, why):
        say(f"SKIPPED: {what}: {why}")
        self.skipped.append(f"{what}: {why}")

    def wanted(self, identifier):
        return not self.options.only or identifier in self.options.only

    def attempt(self, what, work, *arguments):
        try:
            work(*arguments)
        except Absent as absent:
            self.skip(what, absent)
        except Failed as failure:
            self.failed = True
            self.skip(what, failure)

    # Ratios

    def compare_all(self):
        wanted = [c for c in COMPARISONS if self.wanted(c.id)]
        for key in dict.fromkeys(c.cloud for c in wanted if c.cloud != "sizes"):
            ordinary = [c for c in wanted if c.cloud == key and c.theirs not in SPECIAL]
            if ordinary:
                self.attempt(", ".join(c.id for c in ordinary), self.compare_with_pcl, key, ordinary)
        special = {"cgal": self.compare_with_cgal, "threads": self.compare_threads, "size": self.compare_sizes}
        for comparison in wanted:
            if comparison.theirs in special:
                self.attempt(comparison.id, special[comparison.theirs], comparison)
        self.results.sort(key=lambda result: COMPARISONS.index(result.comparison))

    def compare_with_pcl(self, key, comparisons):
        cloud = self.clouds.get(key)
        names = {f"mlsmesh/{c.ours}/threads:1" for c in comparisons} | {c.theirs for c in comparisons}
        timings = self.measure("bench_against_pcl", cloud, names, [1])
        for c in comparisons:
            name = f"mlsmesh/{c.ours}/threads:1"
            self.add_result(c, cloud, timings[name], timings[c.theirs])
            self.add_command(c.id, "bench_against_pcl", cloud, [name, c.theirs], [1])

    def compare_with_cgal(self, c):
        if not self.options.cgal:
            raise Absent("no --cgal PROGRAM is given")
        cloud = self.clouds.get(c.cloud)
        if not cloud.file:
            raise Absent("it reads a file, and this cloud is in none")
        name = f"mlsmesh/{c.ours}/threads:1"
        ours, theirs = Timing(name), Timing("cgal/advancing_front")
        for _ in range(self.options.repetitions):
            once = self.programs.times("bench_against_pcl", cloud, [name], [1], 1)[name]
            ours.cpu, ours.wall, ours.count = ours.cpu + once.cpu, ours.wall + once.wall, once.count
            cpu, wall, theirs.count = peer_once(self.options.cgal, cloud, self.work / "cgal.ply")
            theirs.cpu.append(cpu)
            theirs.wall.append(wall)
        self.times.append((cloud.label, 1, theirs))
        self.add_result(c, cloud, ours, theirs)
        self.add_command(c.id, "bench_against_pcl", cloud, [name], [1])
        self.commands.append((c.id, f"CGAL_PROGRAM advancing_front {cloud.shown.split()[1]} out.ply"))

    def compare_threads(self, c):
        cloud = self.clouds.get(c.cloud)
        one, two = (f"mlsmesh/{c.ours}/threads:{threads}" for threads in (1, 2))
        timings = self.measure("bench_against_pcl", cloud, {one, two}, [1, 2])
        spread = max(timings[one].wall_spread, timings[two].wall_spread)
        gain = min(timings[one].wall) / min(timings[two].wall)
        self.results.append(Result(c, cloud.label, timings[one].spread, two_threads=gain, two_threads_spread=spread))
        self.add_command(c.id, "bench_against_pcl", cloud, [one, two], [1, 2])

    def compare_sizes(self, c):
        if not self.options.large and not self.options.quick:
            raise Absent("needs --large")
        few, many = (10_000, 20_000) if self.options.quick else (1_000_000, 10_000_000)
        cloud = Cloud(f"synthetic, {few:,} and {many:,} points", ["--points", f"{few},{many}"], f"--points {few},{many}")
        small, large = (f"{c.ours}/points:{points}/threads:1" for points in (few, many))
        timings = self.measure("bench_steps", cloud, {small, large}, [1],
                               min(self.options.repetitions, LARGE_REPETITIONS))
        per_point = [[min(values) / points for values in (timings[name].cpu, timings[name].wall)]
                     for name, points in ((large, many), (small, few))]
        spread = max(timings[small].spread, timings[large].spread)
        cpu, wall = (ours / theirs for ours, theirs in zip(*per_point))
        self.results.append(Result(c, cloud.label, spread, cpu=cpu, wall=wall))
        self.add_command(c.id, "bench_steps", cloud, [small, large], [1])

    def measure(self, program, cloud, names, threads, repetitions=None):
        timings = self.programs.times(program, cloud, names, threads, repetitions)
        for name in sorted(timings):
            self.times.append((cloud.label, 2 if name.endswith("threads:2") else 1, timings[name]))
        return timings

    def add_result(self, c, cloud, ours, theirs):
        two = self.on_two_threads(cloud, f"mlsmesh/{c.ours}/threads:2")
        self.results.append(Result(
            c, cloud.label, max(ours.spread, theirs.spread), ratio(c, min(ours.cpu), min(theirs.cpu)),
            ratio(c, min(ours.wall), min(theirs.wall)), ratio(c, min(two.wall), min(theirs.wall)), two.wall_spread))

    def on_two_threads(self, cloud, name):
        if (cloud.label, name) not in self.two_threads:
            self.two_threads[cloud.label, name] = self.measure("bench_against_pcl", cloud, {name}, [2])[name]
        return self.two_threads[cloud.label, name]

    def add_command(self, identifier, program, cloud, names, threads):
        words = ["$BIN/" + program, cloud.shown, "--threads", ",".join(map(str, threads)), f"'{filter_of(names)}'", "$REPEAT"]
        self.commands.append((identifier, " ".join(words)))

    # Memory and steps

    def measure_memory(self):
        for memory_run in MEMORY_RUNS:
            if self.wanted(memory_run.id):
                self.attempt(memory_run.id, self.measure_memory_of, memory_run)

    def measure_memory_of(self, memory_run):
        points = memory_run.large if self.options.large else 20_000 if self.options.quick else memory_run.points
        cloud = synthetic(points)
        repetitions = 1 if self.options.quick or self.options.large else 2
        found = [self.programs.memory(cloud, memory_run.flags) for _ in range(repetitions)]
        self.memory.append((memory_run, points, found))
        self.commands.append((memory_run.id, " ".join(["$BIN/bench_memory", cloud.shown, *memory_run.flags])))

    def measure_steps(self):
        sizes = [2_000, 10_000] if self.options.quick else STEP_POINTS
        cloud = Cloud("synthetic", ["--points", ",".join(map(str, sizes))], "")
        named = {(step, size): f"{step}/points:{size}/threads:" for step in STEPS for size in sizes}
        one = self.programs.times("bench_steps", cloud, [name + "1" for name in named.values()], [1])
        largest = [named[step, sizes[-1]] + "2" for step in STEPS]
        two = self.programs.times("bench_steps", cloud, largest, [2])
        columns = {size: {step: one[named[step, size] + "1"] for step in STEPS} for size in sizes}
        self.steps = (sizes, columns, {step: two[named[step, sizes[-1]] + "2"] for step in STEPS})
        self.commands.append(("step", "$BIN/bench_steps --points N --threads N '--benchmark_filter=^STEP/points:' $REPEAT"))

    # Report

    def text(self, others):
        quick = "**A quick run on tiny clouds, once each: these figures show that the programs run and nothing else.**\n\n"
        parts = [quick if self.options.quick else "", report.machine(self.programs.context, others), "\n\n"]
        parts += [f"Best of {self.options.repetitions}; the spread is by how much the slowest repetition of the two sides "
                  "exceeds the best, in CPU time; in brackets, that of ours on two threads in wall time.\n"]
        if self.results:
            parts += ["\n### Ratios\n\n", report.comparison_table(self.results, judge=not self.options.quick)]
        if self.memory:
            parts += ["\n### Memory above the input cloud\n\n", report.memory_table(self.memory, judge=self.options.large)]
        if self.times:
            parts += ["\n### Times behind the ratios\n\n", report.time_table(self.times)]
        if self.steps:
            parts += ["\n### Steps\n\nCPU microseconds a point on one thread (spread), synthetic cloud.\n\n",
                      report.step_table(*self.steps)]
        parts += ["\n### Commands\n\n`scripts/run_benchmarks.py --only FIGURE` runs those of one figure. "
                  "`BIN` is the folder of the programs, `DATA` that of the data, `SAMPLER` and `CGAL_PROGRAM` what the script was given, and `REPEAT` stands for "
                  f"`--benchmark_repetitions={self.options.repetitions} {' '.join(REPEAT_FLAGS)}`.\n\n",
                  report.command_list(self.clouds.commands + self.commands)]
        if self.skipped:
            parts += ["\n### Left out\n\n", *(f"- {line}\n" for line in self.skipped)]
        return "".join(parts)


def parse_options():
    known = [*(c.id for c in COMPARISONS), *(m.id for m in MEMORY_RUNS), "steps"]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=str(ROOT / "build/release/bin"), help="folder of the programs (build/release/bin)")
    parser.add_argument("--data", default=os.environ.get("MLSMESH_DATA_DIR", str(ROOT.parent / "shared/data")),
                        help="folder of the clouds (MLSMESH_DATA_DIR, or ../shared/data)")
    parser.add_argument("--cgal", metavar="PROGRAM",
                        help="called as PROGRAM advancing_front CLOUD OUT.ply, prints its stages as JSON")
    parser.add_argument("--sampler", metavar="PROGRAM", help="called as PROGRAM MESH.ply OUT.pcd --n N --seed S")
    parser.add_argument("--cloud-1m", metavar="FILE", help="cloud of the rows at a million points, in place of the sampler's")
    parser.add_argument("--repetitions", type=int, default=5, help="of which the best counts (5)")
    parser.add_argument("--quick", action="store_true", help="tiny clouds, once each: does everything run?")
    parser.add_argument("--large", action="store_true", help="also 10 and 20 million points: minutes, and gigabytes")
    parser.add_argument("--only", type=lambda text: text.split(","), metavar="FIGURE,...", help=f"of {', '.join(known)}")
    parser.add_argument("--output", metavar="FILE", help="fills the file between its markers, or writes it whole; else prints")
    options = parser.parse_args()
    unknown = set(options.only or []) - set(known)
    if unknown:
        parser.error(f"--only: no figure {', '.join(sorted(unknown))}")
    if options.quick:
        options.repetitions, options.large = 1, False
    if options.repetitions < 1:
        parser.error("--repetitions: must be at least 1")
    return options


def main():
    options = parse_options()
    disturbance = Disturbance()
    with tempfile.TemporaryDirectory() as work:
        session = Session(options, work)
        session.compare_all()
        session.measure_memory()
        if session.wanted("steps"):
            session.attempt("steps", session.measure_steps)
        others = disturbance.share()
        if others > 0.1 and not options.quick:
            say(f"WARNING: the machine was not quiet: other programs took {100 * others:.0f} % of a core")
        report.write(session.text(others), options.output)
    return 1 if session.failed else 0


if __name__ == "__main__":
    sys.exit(main())
