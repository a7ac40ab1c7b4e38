# SPDX-License-Identifier: BSD-3-Clause
"""The clouds that run_benchmarks.py measures on."""

import pathlib

from benchmark_runs import Absent, Cloud, run

DATA_FILES = {"bunny": "cloud/bunny_35947.pcd", "armadillo": "sampled/armadillo_200k_uniform.pcd"}
QUICK_POINTS = {"bunny": 5_000, "armadillo": 10_000, "1m": 20_000}
SAMPLES = ["--n", "1000000", "--seed", "9"]


def synthetic(points):
    return Cloud(f"synthetic, {points:,} points", ["--points", points], f"--points {points}")


def from_file(label, file, shown):
    return Cloud(label, ["--cloud", file], f"--cloud {shown}", str(file))


class Clouds:
    """Finds each cloud once. `skip(what, why)` is told where the synthetic one takes a cloud's place."""

    def __init__(self, options, work, skip):
        self.options = options
        self.work = pathlib.Path(work)
        self.data = pathlib.Path(options.data)
        self.skip = skip
        self.found = {}
        self.commands = []  # (file, command) of what was made

    def get(self, key):
        """The cloud `key` ("1m" or one of DATA_FILES); raises Absent."""
        if key not in self.found:
            self.found[key] = self._find(key)
        return self.found[key]

    def _find(self, key):
        if self.options.quick:
            return synthetic(QUICK_POINTS[key])
        if key == "1m":
            return self._million()
        file = self.data / DATA_FILES[key]
        if not file.is_file():
            raise Absent(f"no {DATA_FILES[key]} in the data; name their folder with --data or MLSMESH_DATA_DIR")
        return from_file(file.stem, file, f"$DATA/{DATA_FILES[key]}")

    def _million(self):
        if self.options.cloud_1m:
            file = pathlib.Path(self.options.cloud_1m)
            return from_file(file.stem, file, file.name)
        mesh = self.data / "mesh/armadillo.ply"
        if self.options.sampler and mesh.is_file():
            return self._sampled(mesh)
        why = "no mesh/armadillo.ply in the data" if self.options.sampler else "neither --cloud-1m nor --sampler is given"
        self.skip("armadillo, 1,000,000 points", f"{why}; the synthetic cloud takes its place")
        return synthetic(1_000_000)

    def _sampled(self, mesh):
        file = self.work / "armadillo_1m.pcd"
        run([self.options.sampler, mesh, file, *SAMPLES])
        self.commands.append((file.name, f"SAMPLER $DATA/mesh/{mesh.name} {file.name} {' '.join(SAMPLES)}"))
        return from_file("armadillo, 1,000,000 points", file, file.name)
