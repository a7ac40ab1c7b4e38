# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmark programs and reads what they measured. Used by run_benchmarks.py."""

import dataclasses
import json
import os
import pathlib
import subprocess
import sys
import time

REPEAT_FLAGS = ["--benchmark_min_time=0.001", "--benchmark_enable_random_interleaving=true"]


class Absent(Exception):
    """Something that a figure needs was not given; the text says what."""


class Failed(Exception):
    """A program could not be run or ended badly; the text says which and how."""


@dataclasses.dataclass
class Timing:
    """One entry a repetition, in milliseconds; `count` is what the benchmark says it made."""

    name: str
    cpu: list = dataclasses.field(default_factory=list)
    wall: list = dataclasses.field(default_factory=list)
    count: str = ""

    @property
    def spread(self):
        """By how much of the best the slowest repetition was slower, in CPU time."""
        return max(self.cpu) / min(self.cpu) - 1

    @property
    def wall_spread(self):
        return max(self.wall) / min(self.wall) - 1


@dataclasses.dataclass
class Cloud:
    """A cloud as the programs are told of it: arguments to use, and the same as text for a reader."""

    label: str
    arguments: list
    shown: str
    file: str = ""  # where it is in one


def say(text):
    print(text, file=sys.stderr, flush=True)


def run(command):
    """Runs a command; returns its standard output."""
    command = [str(word) for word in command]
    say("  " + " ".join([pathlib.Path(command[0]).name, *command[1:]]))
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    except OSError as error:
        raise Failed(f"{command[0]}: {error.strerror}") from error
    if done.returncode != 0:
        last = (done.stderr.strip() or "no message").splitlines()[-1]
        raise Failed(f"{command[0]}: exit code {done.returncode}: {last}")
    return done.stdout


class Disturbance:
    """How busy other programs kept the machine since this was made."""

    def __init__(self):
        self.start = time.monotonic(), self._busy()

    @staticmethod
    def _busy():
        """Seconds of all cores in which anything ran but this script and what it started."""
        first = pathlib.Path("/proc/stat").read_text(encoding="utf-8").splitlines()[0].split()[1:]
        user, nice, system, _idle, _wait, irq, softirq, steal = map(int, first[:8])
        own = sum(os.times()[:4])
        return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK") - own

    def share(self):
        """Of one core, 0 for a quiet machine."""
        begin, busy = self.start
        return max(0.0, (self._busy() - busy) / (time.monotonic() - begin))


class Programs:
    """The benchmark programs of one build, each run in a process of its own."""

    def __init__(self, folder, work, repetitions):
        self.folder = pathlib.Path(folder)
        self.work = pathlib.Path(work)
        self.repetitions = repetitions
        self.context = {}  # Google Benchmark's, of the last run

    def times(self, program, cloud, names, threads, repetitions=None):
        """Timings by name of the named benchmarks, in one process and in mixed order."""
        out = self.work / "times.json"
        command = [self.folder / program, *cloud.arguments, "--threads", ",".join(map(str, threads)), filter_of(names)]
        command += [f"--benchmark_repetitions={repetitions or self.repetitions}", *REPEAT_FLAGS]
        run([*command, f"--benchmark_out={out}", "--benchmark_out_format=json"])
        result = json.loads(out.read_text(encoding="utf-8"))
        self.context = result["context"]
        timings = timings_of(result["benchmarks"])
        missing = [name for name in names if name not in timings]
        if missing:
            raise Failed(f"{program} has no benchmark {', '.join(missing)}")
        return timings

    def memory(self, cloud, flags):
        """What bench_memory prints, as a dictionary."""
        return json.loads(run([self.folder / "bench_memory", *cloud.arguments, *flags]))


def filter_of(names):
    return f"--benchmark_filter=^({'|'.join(sorted(names))})/process_time"


def timings_of(entries):
    timings = {}
    for entry in entries:
        name = entry["run_name"].split("/process_time")[0]
        if entry.get("error_occurred"):
            raise Failed(f"{name}: {entry['error_message']}")
        if entry["run_type"] != "iteration":
            continue
        timing = timings.setdefault(name, Timing(name, count=count_of(entry)))
        timing.cpu.append(entry["cpu_time"])
        timing.wall.append(entry["real_time"])
    return timings


def count_of(entry):
    for thing in ("triangles", "points", "clusters", "representatives"):
        if thing in entry:
            return f"{entry[thing]:,.0f} {thing}"
    return ""


def peer_once(program, cloud, output):
    """CPU (user) and wall milliseconds of one run of a peer called as PROGRAM advancing_front CLOUD OUT.ply."""
    result = json.loads(run([program, "advancing_front", cloud.file, output]))
    stages = result["stages"]
    cpu, wall = (1000 * sum(stage[key] for stage in stages) for key in ("user", "wall"))
    return cpu, wall, f"{result['faces']:,} triangles"
