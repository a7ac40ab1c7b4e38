# SPDX-License-Identifier: BSD-3-Clause
"""Writes what run_benchmarks.py measured as Markdown."""

import os
import pathlib
import re

BEGIN, END = "<!-- results -->", "<!-- end -->"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def percent(share):
    return f"{100 * share:.0f} %"


def ratio_text(value):
    return "–" if value is None else f"{value:.2f}"


def two_threads_text(result):
    if result.two_threads is None:
        return "–"
    return f"{result.two_threads:.2f} ({percent(result.two_threads_spread)})"


def goal_text(result, judge):
    c = result.comparison
    if not c.goal:
        return "–"
    return f"{'≤' if c.at_most else '≥'} {c.goal:g}" + (verdict(result.reached) if judge else "")


def verdict(reached):
    return ", reached" if reached else ", missed"


def machine(context, others):
    """One line on the machine, the build that was measured, and what disturbed it."""
    model = re.search(r"^model name\s*: (.*)$", _read("/proc/cpuinfo"), re.MULTILINE)
    memory = re.search(r"^MemTotal:\s*(\d+)", _read("/proc/meminfo"), re.MULTILINE)
    parts = [model.group(1).strip() if model else "CPU unknown", f"{os.cpu_count()} cores"]
    if memory:
        parts.append(f"{int(memory.group(1)) / 2**20:.0f} GiB")
    parts += [context.get("compiler", "compiler unknown"), f"mlsmesh {context.get('mlsmesh', '?')}"]
    text = ", ".join(parts) + f". Other programs took {percent(others)} of a core meanwhile."
    if context.get("assertions") == "on":
        text += " **Built with assertions: not a release build, the times mean little.**"
    return text


def _read(path):
    try:
        return pathlib.Path(path).read_text(encoding="utf-8")
    except OSError:
        return ""


def comparison_table(results, judge):
    """With `judge`, whether goals are reached: by CPU time on one thread, or by wall time where that is all."""
    heads = ["figure", "work", "cloud", "against", "1 thread, CPU", "1 thread, wall", "2 threads, wall", "spread", "goal"]
    rows = []
    for result in results:
        c = result.comparison
        rows.append([c.id, c.work, result.cloud, c.against, ratio_text(result.cpu), ratio_text(result.wall),
                     two_threads_text(result), percent(result.spread), goal_text(result, judge)])
    return table(heads, rows)


def time_table(entries):
    """Of (cloud, threads, timing)."""
    heads = ["cloud", "benchmark", "threads", "CPU ms", "spread", "wall ms", "spread", "made"]
    rows = []
    for cloud, threads, timing in entries:
        rows.append([cloud, f"`{timing.name}`", threads, f"{min(timing.cpu):.1f}", percent(timing.spread),
                     f"{min(timing.wall):.1f}", percent(timing.wall_spread), timing.count])
    return table(heads, rows)


def memory_table(results, judge):
    """Of (run, points, what bench_memory found each time); goals are judged at full size alone."""
    heads = ["figure", "run", "points", "triangles", "peak, bytes a point", "held at the end", "spread of the peak", "seconds",
             "goal"]
    rows = []
    for memory_run, points, found in results:
        peaks = [figures["peak_bytes_per_point"] for figures in found]
        first = found[0]
        rows.append([memory_run.id, memory_run.work, f"{points:,}", f"{first['triangles']:,}", f"{max(peaks):.0f}",
                     f"{first['held_bytes_per_point']:.0f}", percent(max(peaks) / min(peaks) - 1),
                     f"{min(figures['wall_seconds'] for figures in found):.1f}",
                     memory_goal_text(memory_run, max(peaks), judge)])
    return table(heads, rows)


def memory_goal_text(memory_run, peak, judge):
    if not memory_run.goal:
        return "–"
    goal = f"≤ {memory_run.goal:g}"
    return goal + verdict(peak <= memory_run.goal) if judge else f"{goal} at {memory_run.large:,}"


def step_table(sizes, columns, two_threads):
    """`columns[size][step]` is a Timing on one thread, `two_threads[step]` one on two at the largest size."""
    heads = ["step", *(f"{size:,} points" for size in sizes), "2 threads, wall"]
    rows = []
    for step, two in two_threads.items():
        cells = [columns[size][step] for size in sizes]
        gain = min(cells[-1].wall) / min(two.wall)
        rows.append([f"`{step}`"] + [f"{1000 * min(t.cpu) / size:.3f} ({percent(t.spread)})" for size, t in zip(sizes, cells)]
                    + [f"{gain:.2f} times as fast"])
    return table(heads, rows)


def command_list(commands):
    return "".join(f"- {identifier}: `{command}`\n" for identifier, command in commands)


def write(text, output):
    """To standard output without a file; between the markers of a file that has them; else as the whole file."""
    if not output:
        print(text)
        return
    path = pathlib.Path(output)
    old = _read(path)
    if BEGIN in old and END in old:
        head, rest = old.split(BEGIN, 1)
        text = f"{head}{BEGIN}\n{text}\n{END}{rest.split(END, 1)[1]}"
    path.write_text(text if text.endswith("\n") else text + "\n", encoding="utf-8")
