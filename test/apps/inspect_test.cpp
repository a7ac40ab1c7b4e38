// SPDX-License-Identifier: BSD-3-Clause
#include "../core/test_shapes.h"
#include "program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

using Json = nlohmann::json;

Outcome runInspect(const std::vector<std::string>& arguments) {
  const TemporaryFolder prints;
  return Program(MLSMESH_INSPECT, arguments, prints.path()).wait();
}

std::string objText(const Soup& soup) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const core::Vec3& v : soup.vertices) text << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  for (const auto& [a, b, c] : soup.triangles) text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  return text.str();
}

std::string xyzText(const std::vector<core::Vec3>& points) {
  std::ostringstream text;
  for (const core::Vec3& p : points) text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  return text.str();
}

/// [0, 1] x [0, 1] at height z, facing up.
Soup square(double z) {
  return {{{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

struct Kind {
  std::string name;
  Soup soup;
  std::map<std::string, int> topology;  ///< figures that this kind changes, or that it must leave alone
};

Soup with(Soup soup, const std::vector<core::Vec3>& vertices, const std::vector<core::Triangle>& triangles) {
  soup.vertices.insert(soup.vertices.end(), vertices.begin(), vertices.end());
  soup.triangles.insert(soup.triangles.end(), triangles.begin(), triangles.end());
  return soup;
}

Soup without(Soup soup, std::vector<std::size_t> faces) {
  std::sort(faces.rbegin(), faces.rend());
  for (const std::size_t face : faces)
    soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(face));
  return soup;
}

Soup turned(Soup soup, std::size_t face) {
  std::swap(soup.triangles[face][0], soup.triangles[face][1]);
  return soup;
}

/// A torus of 12 x 8 quads that does not meet itself.
Soup roundTorus() {
  Soup soup = torus(12, 8);
  for (core::Index c = 0; c < 12; ++c) {
    for (core::Index r = 0; r < 8; ++r) {
      const double u = c * 2 * 3.14159265358979 / 12, v = r * 2 * 3.14159265358979 / 8;
      soup.vertices[c * 8 + r] = {(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u),
                                  std::sin(v)};
    }
  }
  return soup;
}

std::vector<Kind> kinds() {
  const Soup ball = octahedron();
  Soup far = ball;
  for (core::Vec3& v : far.vertices) v += core::Vec3(9, 0, 0);
  return {
      {"Sphere",
       ball,
       {{"components", 1}, {"closed", 1}, {"manifold", 1}, {"border_loops", 0}, {"euler", 2}, {"genus", 0}}},
      {"NonManifoldEdge",
       with(ball, {{2, 2, 0}}, {{0, 2, 6}}),
       {{"nonmanifold_edges", 1},
        {"nonmanifold_vertices", 2},
        {"manifold", 0},
        {"genus", -1},
        {"border_edges", 2},
        {"border_chains", 1},
        {"border_loops", 0},
        {"bow_tie_vertices", 0}}},
      {"BowTie",
       with(ball, {{2, 1, 0}, {2, -1, 0}}, {{0, 6, 7}}),
       {{"nonmanifold_edges", 0},
        {"nonmanifold_vertices", 1},
        {"bow_tie_vertices", 1},
        {"components", 1},
        {"edge_components", 2},
        {"border_loops", 1},
        {"genus", -1}}},
      {"FlippedFace", turned(ball, 3), {{"orientation_conflicts", 3}, {"orientable", 1}, {"genus", 0}}},
      {"DuplicateFace",
       with(ball, {}, {{4, 0, 2}}),
       {{"duplicate_faces", 1}, {"nonmanifold_edges", 3}, {"triangles", 9}, {"self_intersections", 0}}},
      {"RepeatedCorner",
       with(ball, {}, {{1, 1, 2}}),
       {{"degenerate_faces", 1}, {"manifold", 1}, {"genus", 0}}},
      {"CollinearFace",
       with(ball, {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}}, {{6, 7, 8}}),
       {{"degenerate_faces", 1}, {"components", 2}, {"self_intersections", 0}}},
      {"CrossingTriangles",
       {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 1}}, {{0, 1, 2}, {3, 4, 5}}},
       {{"self_intersections", 1}, {"components", 2}}},
      {"UnusedVertex",
       with(ball, {{7, 7, 7}}, {}),
       {{"isolated_vertices", 1}, {"euler", 2}, {"vertices", 7}}},
      {"OneHole",
       without(ball, {0}),
       {{"border_loops", 1}, {"border_edges", 3}, {"closed", 0}, {"genus", 0}}},
      {"TwoHoles",
       without(ball, {0, 6}),
       {{"border_loops", 2}, {"border_edges", 6}, {"euler", 0}, {"genus", 0}}},
      {"TwoComponents",
       together(ball, far),
       {{"components", 2}, {"closed_components", 2}, {"euler", 4}, {"genus", 0}}},
      {"InsideOut",
       turned(turned(turned(turned(tetrahedron(), 0), 1), 2), 3),
       {{"inward_components", 1}, {"orientation_conflicts", 0}}},
      {"Torus", roundTorus(), {{"genus", 1}, {"euler", 0}, {"closed", 1}, {"self_intersections", 0}}},
      {"MoebiusBand",
       moebiusBand(9),
       {{"orientable", 0},
        {"genus", -1},
        {"border_loops", 1},
        {"orientation_conflicts", 1},
        {"manifold", 1}}},
      {"UnweldedSoup",
       together(square(0), square(0)),
       {{"coincident_vertices", 4}, {"components", 2}, {"border_edges", 8}}},
  };
}

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

class InspectKind : public testing::TestWithParam<Kind> {};

TEST_P(InspectKind, IsCounted) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", objText(GetParam().soup));
  const std::string report = folder.file("report.json");
  std::string list;
  for (const auto& [name, value] : GetParam().topology) {
    if (value < 0) continue;
    list += (list.empty() ? "" : ",") + name + "=" + std::to_string(value);
  }
  const Outcome outcome = runInspect({mesh, "--quiet", "--json", report, "--require", list});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Json json = Json::parse(readFile(report));
  for (const auto& [name, value] : GetParam().topology) {
    const Json& figure = json["topology"][name];
    if (value < 0) {
      EXPECT_TRUE(figure.is_null()) << name;
    } else if (figure.is_boolean()) {
      EXPECT_EQ(figure.get<bool>(), value == 1) << name;
    } else {
      EXPECT_EQ(figure.get<int>(), value) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, InspectKind, testing::ValuesIn(kinds()),
                         [](const testing::TestParamInfo<Kind>& kind) { return kind.param.name; });

TEST(Inspect, ListsComponentsAndBorders) {
  const TemporaryFolder folder;
  const std::string mesh =
      folder.write("mesh.obj", objText(together(square(0), together(roundTorus(), square(5)))));
  const std::string report = folder.file("report.json");
  ASSERT_EQ(runInspect({mesh, "--quiet", "--json=" + report}).exit_code, 0);
  const Json json = Json::parse(readFile(report));
  ASSERT_EQ(json["components"].size(), 3U);
  EXPECT_EQ(json["components"][0]["triangles"], 192);
  EXPECT_EQ(json["components"][0]["genus"], 1);
  EXPECT_EQ(json["components"][0]["closed"], true);
  EXPECT_EQ(json["components"][1]["area"], 1);
  ASSERT_EQ(json["borders"].size(), 2U);
  EXPECT_EQ(json["borders"][0]["length"], 4);
  EXPECT_EQ(json["borders"][0]["component"], 1);
  EXPECT_EQ(json["borders"][0]["loop"], true);
  EXPECT_EQ(json["topology"]["border_length"], 8);
  EXPECT_EQ(json["topology"]["longest_border"], 4);
  EXPECT_TRUE(json["shape"]["volume"].is_null());
}

TEST(Inspect, MeasuresACloudAndATruth) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", objText(square(0)));
  const std::string truth = folder.write("truth.obj", objText(square(0.125)));
  std::vector<core::Vec3> points;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) points.emplace_back(i / 8.0, j / 8.0, 0.25);
  const std::string cloud = folder.write("cloud.xyz", xyzText(points));
  const std::string report = folder.file("report.json");
  const Outcome outcome =
      runInspect({mesh, "--cloud", cloud, "--truth", truth, "--json", report, "--samples=5000", "--require",
                  "cloud_to_mesh.max_spacings=2,truth.mean<0.2,hausdorff=0.125"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(readFile(report));
  EXPECT_EQ(json["cloud"]["points"], 81);
  EXPECT_EQ(json["cloud"]["spacing"], 0.125);
  EXPECT_EQ(json["cloud_to_mesh"]["mean"], 0.25);
  EXPECT_EQ(json["cloud_to_mesh"]["p95_spacings"], 2);
  EXPECT_GE(json["mesh_to_cloud"]["mean"], 0.25);
  EXPECT_NEAR(json["truth"]["mean"], 0.125, 1e-12);
  EXPECT_EQ(json["truth"]["f_score_0_5"], 0);
  EXPECT_EQ(json["truth"]["normal_consistency"], 1);
  EXPECT_EQ(json["truth"]["same_side"], 1);
  EXPECT_NEAR(json["mesh_to_truth"]["max"], 0.125, 1e-12);
  EXPECT_NE(outcome.out.find("cloud_to_mesh\n"), std::string::npos);
  EXPECT_NE(outcome.out.find("0.25 = 2 spacings"), std::string::npos) << outcome.out;
}

TEST(Inspect, GivesTheSameFiguresOnTwoThreads) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", objText(roundTorus()));
  const std::string cloud = folder.write("cloud.xyz", xyzText(roundTorus().vertices));
  const auto text = [&](const char* threads) {
    return runInspect({mesh, "--cloud", cloud, "--truth", mesh, "--threads", threads}).out;
  };
  EXPECT_EQ(text("1"), text("2"));
}

TEST(Inspect, WeldsWhenAsked) {
  const TemporaryFolder folder;
  const Soup apart = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                      {{0, 1, 2}, {3, 4, 5}}};
  const std::string mesh = folder.write("mesh.obj", objText(apart));
  EXPECT_EQ(runInspect({mesh, "--require", "components=2,welded_vertices=0"}).exit_code, 0);
  EXPECT_EQ(runInspect({mesh, "--weld", "--require", "components=1,welded_vertices=2,vertices=4"}).exit_code,
            0);
}

TEST(Inspect, WarnsOfAFileWithoutFaces) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  const Outcome outcome = runInspect({mesh, "--cloud", mesh, "--require", "closed=1,cloud_to_mesh.mean<1"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("points.obj: holds no faces"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("cloud_to_mesh.mean has no value"), std::string::npos) << outcome.err;
}

struct Ask {
  std::string list;
  int exit_code;
  std::string told;  ///< what stderr has; empty: nothing at all
};

void PrintTo(const Ask& ask, std::ostream* out) {
  *out << ask.list;
}

class InspectRequire : public testing::TestWithParam<Ask> {};

TEST_P(InspectRequire, DecidesTheExitCode) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", objText(square(0)));
  const std::string report = folder.file("report.json");
  const Outcome outcome = runInspect({mesh, "--quiet", "--json", report, "--require", GetParam().list});
  EXPECT_EQ(outcome.exit_code, GetParam().exit_code) << outcome.err;
  if (GetParam().told.empty())
    EXPECT_EQ(outcome.err, "");
  else
    EXPECT_NE(outcome.err.find(GetParam().told), std::string::npos) << outcome.err;
  const auto lines = static_cast<int>(std::count(outcome.err.begin(), outcome.err.end(), '\n'));
  EXPECT_EQ(lines, GetParam().told.empty() ? 0 : 1) << outcome.err;
  const std::vector<std::string> wrong_usage = {"mesh.obj"}, measured = {"mesh.obj", "report.json"};
  EXPECT_EQ(folder.names(), GetParam().exit_code == 2 ? wrong_usage : measured);
}

INSTANTIATE_TEST_SUITE_P(
    Lists, InspectRequire,
    testing::Values(Ask{"components=1,self_intersections=0,border_loops<=3,closed=0", 0, ""},
                    Ask{"triangles==2, vertices != 3, area>=1, area<=1", 0, ""},
                    Ask{"area<1.0001,area>0.9999,manifold=true,closed=no", 0, ""},
                    Ask{"topology.components=1", 0, ""},
                    Ask{"closed=1", 1, "requirement 'closed=1' does not hold: topology.closed is no"},
                    Ask{"border_loops<1", 1, "topology.border_loops is 1"}, Ask{"triangles>2", 1, "is 2"},
                    Ask{"triangles<=1", 1, "is 2"}, Ask{"vertices>=5", 1, "is 4"},
                    Ask{"vertices!=4", 1, "is 4"}, Ask{"volume>=0", 1, "shape.volume has no value"},
                    Ask{"componets=1", 2, "did you mean 'components'?"}, Ask{"components", 2, "'components'"},
                    Ask{"components=", 2, "'components='"}, Ask{"=1", 2, "'=1'"},
                    Ask{"components=one", 2, "'components=one'"}, Ask{"components=1x", 2, "1x"},
                    Ask{"components=1,", 2, "--require"}, Ask{"components!1", 2, "'components!1'"},
                    Ask{"cloud_to_mesh.max<1", 2, "add it"}, Ask{"hausdorff<1", 2, "--truth FILE"},
                    Ask{"", 2, "--require"}));

TEST(InspectRequire, TellsEveryFailure) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", objText(square(0)));
  const Outcome outcome = runInspect({mesh, "--quiet", "--require", "closed=1,components=1,genus=7"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err,
            "mlsmesh_inspect: requirement 'closed=1' does not hold: topology.closed is no\n"
            "mlsmesh_inspect: requirement 'genus=7' does not hold: topology.genus is 0\n");
}

TEST(InspectRequire, AsksForTheGroupOfANameThatSeveralHave) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", objText(square(0)));
  const Outcome outcome = runInspect({mesh, "--cloud", mesh, "--require", "mean<1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("cloud_to_mesh.mean or mesh_to_cloud.mean"), std::string::npos) << outcome.err;
}

struct Misuse {
  std::vector<std::string> arguments;  ///< MESH, CUT, ... stand for files
  std::string culprit;
};

void PrintTo(const Misuse& misuse, std::ostream* out) {
  for (const std::string& argument : misuse.arguments) *out << argument << ' ';
}

class InspectMisuse : public testing::TestWithParam<Misuse> {};

TEST_P(InspectMisuse, IsOneLineThatNamesTheCulpritAndLeavesNothing) {
  const TemporaryFolder folder, inputs;
  const std::map<std::string, std::string> files = {
      {"MESH", inputs.write("mesh.obj", objText(square(0)))},
      {"BAD", inputs.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n")},
      {"EMPTY", inputs.write("empty.ply", "")},
      {"ABSENT", inputs.file("absent.ply")},
      {"CUT",
       inputs.write("cut.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
                    "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
                    "0\n0 1 0\n3 0 1\n")},
      {"NAN", inputs.write("nan.xyz", "nan nan nan\n")},
      {"POINTS", inputs.write("points.obj", "v 0 0 0\n")},
      {"OUT", folder.file("report.json")},
      {"NOWHERE", folder.file("no/report.json")}};
  std::vector<std::string> arguments = GetParam().arguments;
  for (std::string& argument : arguments)
    if (files.count(argument) != 0) argument = files.at(argument);
  const Outcome outcome = runInspect(arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("mlsmesh_inspect: ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().culprit), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder.names().empty());
}

INSTANTIATE_TEST_SUITE_P(
    Cases, InspectMisuse,
    testing::Values(Misuse{{}, "MESH is missing"}, Misuse{{"MESH", "MESH"}, "arguments"},
                    Misuse{{"mesh.off"}, "'off'"}, Misuse{{"ABSENT", "--json", "OUT"}, "absent.ply"},
                    Misuse{{"EMPTY", "--json", "OUT"}, "empty.ply: is empty"},
                    Misuse{{"BAD", "--json", "OUT"}, "bad.obj: line 4, 'f 1 2 x'"},
                    Misuse{{"CUT", "--json", "OUT"}, "cut.ply"},
                    Misuse{{"MESH", "--cloud", "ABSENT", "--json", "OUT"}, "absent.ply"},
                    Misuse{{"MESH", "--cloud", "cloud.las"}, "cloud.las"},
                    Misuse{{"MESH", "--cloud", "NAN", "--json", "OUT"},
                           "nan.xyz: the cloud has no finite point"},
                    Misuse{{"MESH", "--truth", "POINTS", "--json", "OUT"}, "points.obj"},
                    Misuse{{"MESH", "--json", "NOWHERE"}, "does not exist"},
                    Misuse{{"MESH", "--json", "MESH"}, "would overwrite the input"},
                    Misuse{{"MESH", "--samples", "0"}, "--samples"},
                    Misuse{{"MESH", "--threads", "-1"}, "--threads"},
                    Misuse{{"MESH", "--requires", "closed=1"}, "did you mean --require"}));

TEST(Inspect, EveryFigureIsExplained) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", objText(square(0)));
  const std::string report = folder.file("report.json");
  ASSERT_EQ(runInspect({mesh, "--cloud", mesh, "--truth", mesh, "--quiet", "--json", report}).exit_code, 0);
  const std::string page = readFile(MLSMESH_SOURCE_DIR "/docs/inspect.md");
  const Json json = Json::parse(readFile(report));
  for (const auto& [group, figures] : json.items()) {
    EXPECT_NE(page.find(group), std::string::npos) << group;
    if (!figures.is_object()) continue;
    for (const auto& [name, value] : figures.items()) {
      const bool is_tolerance =
          name.find("_0_25") != std::string::npos || name.find("_0_1") != std::string::npos;
      const bool is_multiple =
          name.find("_spacings") != std::string::npos || name.find("_diagonals") != std::string::npos;
      if (is_tolerance || is_multiple) continue;
      const bool is_explained = page.find("`" + name + "`") != std::string::npos ||
                                page.find("`" + group + "." + name + "`") != std::string::npos;
      EXPECT_TRUE(is_explained) << group << "." << name;
    }
  }
}

TEST(Inspect, HelpNamesEveryFigure) {
  const Outcome outcome = runInspect({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* name : {"self_intersections", "border_loops", "max_spacings", "f_score_0_25", "hausdorff"})
    EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace mlsmesh::test
