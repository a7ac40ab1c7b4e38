# SPDX-License-Identifier: BSD-3-Clause
"""What run_benchmarks.py compares with what: the rows of its tables."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Comparison:
    """Two benchmarks of one program on one cloud. The ratio says how many times as fast ours is; with
    `at_most`, how many times as long it takes."""

    id: str
    work: str
    against: str
    cloud: str
    ours: str
    theirs: str
    goal: float = 0  # 0: none
    at_most: bool = False


@dataclasses.dataclass(frozen=True)
class MemoryRun:
    """A run of bench_memory at `large` points with --large, else at `points`."""

    id: str
    work: str
    flags: tuple
    large: int
    points: int = 1_000_000
    goal: float = 0  # bytes a point, at the peak; 0: none


GP3 = "PCL's normals (20 neighbours) and GP3"
KNN = "FLANN's tree and bare k-NN (k = 16) over the ordered cloud"
MLS = "pcl::MovingLeastSquares, radius of 20 neighbours on average"
POISSON = "PCL's normals and Poisson, depth 8"

COMPARISONS = [
    Comparison("no-reduction-gp3", "`--no-reduction`", GP3, "armadillo", "no_reduction", "pcl/normals_and_gp3", 8),
    Comparison("no-reduction-cgal", "`--no-reduction`", "CGAL's advancing front", "armadillo", "no_reduction", "cgal", 5),
    Comparison("no-reduction-knn", "`--no-reduction`", KNN, "1m", "no_reduction", "flann/tree_and_nearest_16", 2.5, True),
    Comparison("no-reduction-knn-flat", "the same without the PolygonMesh", KNN, "1m", "no_reduction_flat",
               "flann/tree_and_nearest_16", 0, True),
    Comparison("level-0-bunny", "default, level 0", GP3, "bunny", "level_0", "pcl/normals_and_gp3", 20),
    Comparison("level-0-armadillo", "default, level 0", GP3, "armadillo", "level_0", "pcl/normals_and_gp3", 20),
    Comparison("level-2-bunny", "default, levels 0 to 2", GP3, "bunny", "levels_0_to_2", "pcl/normals_and_gp3", 5),
    Comparison("level-2-armadillo", "default, levels 0 to 2", GP3, "armadillo", "levels_0_to_2", "pcl/normals_and_gp3", 5),
    Comparison("level-2-poisson", "default, levels 0 to 2", POISSON, "armadillo", "levels_0_to_2",
               "pcl/normals_and_poisson_8"),
    Comparison("projection-bunny", "MLS projection of every point", MLS, "bunny", "projection", "pcl/moving_least_squares", 5),
    Comparison("projection-armadillo", "MLS projection of every point", MLS, "armadillo", "projection",
               "pcl/moving_least_squares", 5),
    Comparison("threads", "default, levels 0 to 2, on 2 threads", "the same on 1 thread", "1m", "levels_0_to_2",
               "threads", 1.75),
    Comparison("size", "default, levels 0 to 2, time a point of the larger cloud", "of the smaller", "sizes",
               "pipeline/levels_0_to_2", "size", 1.25, True),
]

MEMORY_RUNS = [
    MemoryRun("memory-level-0", "default, level 0, with the PolygonMesh", (), 20_000_000, goal=120),
    MemoryRun("memory-level-0-flat", "default, level 0, without", ("--flat",), 20_000_000),
    MemoryRun("memory-no-reduction", "`--no-reduction`, with the PolygonMesh", ("--no-reduction",), 10_000_000),
    MemoryRun("memory-no-reduction-flat", "`--no-reduction`, without", ("--no-reduction", "--flat"), 10_000_000, goal=300),
]

STEP_POINTS = [10_000, 100_000, 1_000_000]
STEPS = ["point_set", "kd_tree", "nearest_16", "flann/tree_and_nearest_16", "noise", "projection/all_points", "clustering",
         "reduction", "outliers", "features", "triangulation/representatives", "triangulation/all_points",
         "refinement/level_1", "report/level_0", "pipeline/level_0", "pipeline/levels_0_to_2", "pipeline/no_reduction"]
