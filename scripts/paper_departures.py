#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Takes departures from the paper back one at a time, on the bunny, and writes what that does into docs/paper.md.

Each row changes the options in its second column and nothing else. Counts and distances are those of mlsmesh_inspect on the
finest mesh. An absent cloud or a program that fails ends the script with exit code 1.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

from paper_table import CLOUDS, arguments, run_reconstruct, seconds, write_between

NEAREST = "--projection.support_rule nearest_distance --projection.support_factor 3"
FRONT = "--no-reduction --levels 0 --triangulation.seeds single_triangle --triangulation.heal false"
NARROW = "--triangulation.bend_first 15 --triangulation.bend_step 15 --triangulation.bend_max 90"

# (what is shown, options that all rows have, [(row, further options)])
BLOCKS = (
    (
        "the pipeline, two refinement steps",
        "",
        (
            ("default", ""),
            ("preset `paper`", "--preset paper"),
            ("preset `printed`", "--preset printed"),
            ("split by the regression plane", "--clustering.split_plane regression_plane"),
            ("split rule *and*", "--clustering.split_rule size_and_variation"),
            ("h = 3 d1", NEAREST),
            ("Levin's iteration", "--projection.method levin"),
            ("both", f"--projection.method levin {NEAREST}"),
            ("representatives anywhere", "--reduction.clamp finite_only"),
            ("test by alpha", "--refinement.test mean_offset --refinement.threshold 0.015"),
            ("one edge after the other", "--refinement.split_mode sequential"),
            ("no fold guard", "--refinement.fold_guard false"),
            ("flips by length", "--refinement.flips length"),
            ("flips by length, no guard", "--refinement.flips length --refinement.flip_guard false"),
            ("neither guard", "--refinement.flips length --refinement.flip_guard false --refinement.fold_guard false"),
        ),
    ),
    (
        "the front alone, over all points",
        FRONT,
        (
            ("the front of the default", ""),
            ("the printed front", "--preset printed"),
            ("first in, first out", "--triangulation.order first_in_first_out"),
            ("neighbours of u only", "--triangulation.candidates first_endpoint"),
            ("largest angle", "--triangulation.apex_choice largest_angle"),
            ("narrow windows", NARROW),
            ("narrow windows, largest angle", f"{NARROW} --triangulation.apex_choice largest_angle"),
            ("edges to 3 d_min", "--triangulation.length_rule nearest_distance --triangulation.length_factor 3"),
            ("star of the new point only", "--triangulation.overlap_test apex_star"),
            ("small loops left", "--triangulation.fill_small_loops false"),
        ),
    ),
)
HEAD = ["what is taken back", "options", "vertices, level 0", "triangles", "parts", "border loops", "meeting pairs"]
HEAD += ["folded edges", "angle, 5 %", "cloud to mesh, mean", "cloud to mesh, 99 %", "seconds"]


def measure(options, cloud, more, folder):
    mesh, found = folder / "mesh.ply", folder / "inspect.json"
    report = run_reconstruct(options, cloud, mesh, more)
    command = [options.bin / "mlsmesh_inspect", mesh, "--cloud", cloud, "--json", found]
    done = subprocess.run([str(part) for part in command], check=False, stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        sys.exit(f"paper_departures: exit code {done.returncode} from: {' '.join(map(str, command))}")
    return report, json.loads(found.read_text())


def row(name, more, report, found):
    topology, shape, distance = found["topology"], found["shape"], found["cloud_to_mesh"]
    cells = [name, f"`{more}`" if more else "", f"{report['levels'][0]['vertices']:,}"]
    cells += [f"{topology[key]:,}" for key in ("triangles", "components", "border_loops", "self_intersections")]
    cells += [f"{shape['folded_edges']:,}", f"{shape['angle_p5']:.1f}"]
    cells += [f"{distance['mean_spacings']:.3f}", f"{distance['p99_spacings']:.3f}", f"{sum(seconds(report)):.2f}"]
    return "| " + " | ".join(cells) + " |"


def main():
    options = arguments(__doc__)
    cloud = options.data / CLOUDS["bunny"]
    if not cloud.is_file():
        sys.exit(f"paper_departures: no {CLOUDS['bunny']} in {options.data}")
    parts = []
    with tempfile.TemporaryDirectory() as work:
        for title, common, rows in BLOCKS:
            options_of_all = f", all rows with `{common}`" if common else ""
            lines = [f"On the bunny, {title}{options_of_all}:", ""]
            lines += ["| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)]
            for name, more in rows:
                measured = measure(options, cloud, f"{more} {common}".split(), pathlib.Path(work))
                lines.append(row(name, more, *measured))
            parts.append("\n".join(lines))
    write_between("<!-- departures -->", "<!-- end of departures -->", "\n\n".join(parts), options)


if __name__ == "__main__":
    main()
