// SPDX-License-Identifier: BSD-3-Clause
// What mlsmesh_reconstruct reads, writes and reports when all is well.
#include "common/parameter_table.h"
#include "reconstruct_fixture.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <set>

namespace mlsmesh::test {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kCount = 3000;

/// The mesh is the closed unit sphere, its colours and labels those of the places.
void expectColoredSphere(const PlyMesh& mesh, bool with_label) {
  const std::size_t x = mesh.column("x");
  const std::size_t red = mesh.column("red");
  ASSERT_EQ(mesh.column("green"), red + 1);
  ASSERT_EQ(mesh.column("blue"), red + 2);
  ASSERT_GT(mesh.rows.size(), 500u);
  EXPECT_EQ(mesh.faces.size(), 2 * mesh.rows.size() - 4);
  double worst_color = 0;
  int wrong_labels = 0;
  for (const std::vector<double>& row : mesh.rows) {
    const std::array<double, 3> p = {row[x], row[x + 1], row[x + 2]};
    EXPECT_NEAR(p[0] * p[0] + p[1] * p[1] + p[2] * p[2], 1, 0.01);
    const std::array<int, 3> color = colorAt(p);
    for (std::size_t i = 0; i < 3; ++i)
      worst_color = std::max(worst_color, std::abs(row[red + i] - color[i]));
    const bool inside = std::min({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > 0.15;
    if (with_label && inside && row[mesh.column("label")] != octantOf(p)) ++wrong_labels;
  }
  EXPECT_LT(worst_color, 12);
  EXPECT_EQ(wrong_labels, 0);
}

class Reconstruct : public ReconstructTest {
 protected:
  std::string sphere() const { return folder_.write("sphere.ply", spherePly(kCount)); }
  Json readJson(const std::string& name) const { return Json::parse(readFile(folder_.file(name))); }
};

}  // namespace

TEST_F(Reconstruct, ReadsEveryFormatWithColorAndLabel) {
  const std::vector<std::pair<std::string, std::string>> inputs = {{"in.pcd", spherePcd(kCount)},
                                                                   {"in.ply", spherePly(kCount)},
                                                                   {"in.obj", sphereObj(kCount)},
                                                                   {"in.vtk", sphereVtk(kCount)},
                                                                   {"in.xyz", sphereXyz(kCount)}};
  for (const auto& [name, content] : inputs) {
    SCOPED_TRACE(name);
    runWell({folder_.write(name, content), folder_.file("out.ply"), "--quiet"});
    const bool with_label = name != "in.obj" && name != "in.xyz";
    expectColoredSphere(readPly("out.ply"), with_label);
  }
}

TEST_F(Reconstruct, WritesEveryFormatWithoutLoss) {
  const std::string input = sphere();
  runWell({input, folder_.file("direct.ply")});
  const PlyMesh direct = readPly("direct.ply");
  for (const char* extension : {"ply", "obj", "vtk", "vtp"}) {
    SCOPED_TRACE(extension);
    const std::string written = folder_.file(std::string("written.") + extension);
    runWell({input, written});
    // Without reduction and refinement the vertices that come back are the points that were read.
    runWell({written, folder_.file("back.ply"), "--no-reduction", "--levels", "0"});
    const PlyMesh back = readPly("back.ply");
    std::vector<std::string> columns = {"x", "y", "z", "red", "green", "blue"};
    if (std::string(extension) != "obj") columns.push_back("label");
    EXPECT_EQ(back.sorted(columns), direct.sorted(columns));
  }
}

TEST_F(Reconstruct, PlyIsWhatEveryReaderKnows) {
  runWell({sphere(), folder_.file("out.ply")});
  const PlyMesh mesh = readPly("out.ply");
  const std::vector<std::string> names = {"x",     "y",  "z",  "red", "green",    "blue",
                                          "label", "nx", "ny", "nz",  "curvature"};
  EXPECT_EQ(mesh.names, names);
  EXPECT_NE(mesh.header.find("format binary_little_endian 1.0\n"), std::string::npos);
  EXPECT_NE(mesh.header.find("property list uchar int vertex_indices\n"), std::string::npos);
  std::set<int> used;
  for (const auto& face : mesh.faces) used.insert(face.begin(), face.end());
  EXPECT_EQ(used.size(), mesh.rows.size()) << "vertices that no triangle uses";
}

TEST_F(Reconstruct, StlSaysWhatItLoses) {
  const Outcome outcome =
      run({sphere(), folder_.file("out.stl"), "--quiet", "--json", folder_.file("r.json")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "mlsmesh_reconstruct: warning: " + folder_.file("out.stl") +
                             ": this format has no colour; write .ply to keep it\n");
  const Json json = readJson("r.json");
  EXPECT_EQ(fs::file_size(folder_.file("out.stl")),
            84 + 50 * json["levels"].back()["triangles"].get<std::size_t>());
  EXPECT_EQ(json["warnings"].size(), 1u);
}

TEST_F(Reconstruct, DoubleCoordinatesKeepMillimetres) {
  const std::array<double, 3> center = {448123.125, 5412987.75, 312.5};
  const double radius = 5;
  const std::string input = folder_.write("utm.ply", sphereDoublePly(kCount, radius, center));
  for (const char* extension : {"ply", "obj", "vtk", "vtp"}) {
    SCOPED_TRACE(extension);
    const std::string written = folder_.file(std::string("utm_out.") + extension);
    runWell({input, written});
    runWell({written, folder_.file("back.ply"), "--no-reduction", "--levels", "0"});
    const PlyMesh mesh = readPly("back.ply");
    EXPECT_NE(mesh.header.find("property double x"), std::string::npos);
    double worst = 0;
    for (const std::vector<double>& row : mesh.rows) {
      const double distance = std::hypot(row[0] - center[0], row[1] - center[1], row[2] - center[2]);
      worst = std::max(worst, std::abs(distance - radius));
    }
    EXPECT_LT(worst, 0.01);
    std::set<double> eastings;
    for (const std::vector<double>& row : mesh.rows) eastings.insert(row[0]);
    EXPECT_GT(eastings.size(), mesh.rows.size() / 2) << "coordinates were rounded to float";
  }
  const Outcome stl = run({input, folder_.file("utm.stl")});
  EXPECT_EQ(stl.exit_code, 0);
  EXPECT_NE(stl.err.find("double coordinates"), std::string::npos) << stl.err;
}

TEST_F(Reconstruct, InputMillimetresSurviveUntouched) {
  const std::array<double, 3> center = {448123.125, 5412987.75, 312.5};
  const std::string content = sphereDoublePly(500, 5, center);
  runWell({folder_.write("utm.ply", content), folder_.file("out.ply"), "--no-reduction", "--levels", "0"});
  std::vector<std::vector<double>> expected;
  for (const SpherePoint& point : spherePoints(500)) {
    expected.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) expected.back().push_back(center[i] + 5 * point.position[i]);
  }
  std::sort(expected.begin(), expected.end());
  const std::vector<std::vector<double>> rows = readPly("out.ply").sorted({"x", "y", "z"});
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(rows[i][axis], expected[i][axis], 1e-8);
  }
}

TEST_F(Reconstruct, AllLevels) {
  const std::string out = runWell({sphere(), folder_.file("m.v2.ply"), "--all-levels", "-levels", "2"});
  const std::vector<std::string> names = {"m.v2.L0.ply", "m.v2.L1.ply", "m.v2.L2.ply", "m.v2.ply",
                                          "sphere.ply"};
  EXPECT_EQ(folder_.names(), names);
  EXPECT_EQ(readFile(folder_.file("m.v2.L2.ply")), readFile(folder_.file("m.v2.ply")));
  for (const std::string name : {"m.v2.L0.ply", "m.v2.L1.ply"}) {
    const PlyMesh coarse = readPly(name);
    const PlyMesh fine = readPly("m.v2.ply");
    ASSERT_LT(coarse.rows.size(), fine.rows.size());
    const std::size_t x = fine.column("x");
    for (std::size_t v = 0; v < coarse.rows.size(); ++v) {
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(coarse.rows[v][x + i], fine.rows[v][x + i]);
    }
  }
  for (const std::string word : {"read", "triangulation", "refinement 2", "write", "total", "m.v2.L1.ply"}) {
    EXPECT_NE(out.find(word), std::string::npos) << word << " not in:\n" << out;
  }
}

TEST_F(Reconstruct, Json) {
  const std::string input = folder_.write(
      "in.xyz", sphereXyz(kCount) + "nan 0 0 1 2 3\n0 0 inf 1 2 3\n" + "1 0 0 1 2 3\n1 0 0 4 5 6\n");
  runWell({input, folder_.file("out.ply"), "--json", folder_.file("r.json"), "--quiet", "--threads", "1"});
  const Json json = readJson("r.json");
  EXPECT_EQ(json["input"]["file"], input);
  EXPECT_EQ(json["input"]["points"], kCount + 4);
  EXPECT_EQ(json["input"]["used"], kCount + 1);
  EXPECT_EQ(json["input"]["non_finite"], 2);
  EXPECT_EQ(json["input"]["duplicates"], 1);
  EXPECT_NEAR(json["input"]["spacing"].get<double>(), std::sqrt(4 * M_PI / kCount), 0.02);
  EXPECT_GT(json["representatives"], 200);
  EXPECT_GT(json["peak_rss_bytes"].get<double>(), 1e6);
  EXPECT_EQ(json["threads"], 1);
  EXPECT_EQ(json["preset"], "default");
  std::vector<std::string> stages;
  for (const Json& stage : json["stages"]) {
    stages.push_back(stage["name"]);
    EXPECT_GE(stage["seconds"].get<double>(), 0);
  }
  ASSERT_GT(stages.size(), 5u);
  EXPECT_EQ(stages.front(), "read");
  EXPECT_EQ(stages.back(), "write");
  ASSERT_EQ(json["levels"].size(), 3u);
  const Json& finest = json["levels"][2];
  const PlyMesh mesh = readPly("out.ply");
  EXPECT_EQ(finest["vertices"], mesh.rows.size());
  EXPECT_EQ(finest["triangles"], mesh.faces.size());
  EXPECT_EQ(finest["components"], 1);
  EXPECT_EQ(finest["border_loops"], 0);
  EXPECT_EQ(finest["genus"], 0);
  EXPECT_EQ(finest["file"], folder_.file("out.ply"));
  EXPECT_TRUE(json["levels"][0]["file"].is_null());
}

TEST_F(Reconstruct, ClosesHolesAndSaysSo) {
  std::string bowl, row;
  std::istringstream rows(sphereXyz(kCount));
  while (std::getline(rows, row)) {
    double x = 0, y = 0, z = 1;
    char comma = 0;
    std::istringstream(row) >> x >> comma >> y >> comma >> z;
    if (z < 0.7) bowl += row + "\n";
  }
  const std::string input = folder_.write("bowl.xyz", bowl);
  const auto run_with = [&](std::vector<std::string> options) {
    options.insert(options.end(), {input, folder_.file("out.ply"), "--json", folder_.file("r.json")});
    return runWell(options);
  };
  EXPECT_EQ(run_with({}).find("holes:"), std::string::npos);
  EXPECT_EQ(readJson("r.json")["levels"][2]["border_loops"], 1);
  EXPECT_EQ(readJson("r.json")["holes"]["closed"], 0);
  const std::vector<std::vector<std::string>> ways = {
      {"--watertight"}, {"--watertight=true"}, {"--hole-size", "1000"}, {"-hole_size=1000"}};
  for (const std::vector<std::string>& options : ways) {
    EXPECT_NE(run_with(options).find("holes: 1 closed"), std::string::npos) << options.front();
    const Json json = readJson("r.json");
    EXPECT_EQ(json["holes"]["closed"], 1);
    EXPECT_EQ(json["holes"]["open"], 0);
    for (const Json& level : json["levels"]) {
      EXPECT_EQ(level["border_loops"], 0);
      EXPECT_EQ(level["vertex_kinds"]["patch"], json["holes"]["patch_vertices"]);
    }
    EXPECT_GT(json["holes"]["patch_vertices"], 0);
  }
  run_with({"--hole-size", "1"});
  EXPECT_EQ(readJson("r.json")["levels"][0]["border_loops"], 1);
}

TEST_F(Reconstruct, CommandLineOverConfigOverPreset) {
  const std::string input = sphere();
  const std::string config = folder_.write(
      "run.cfg",
      "# an example\npreset = printed # with a comment\nlevels=1\r\n\n  triangulation.neighbors = 18\n");
  const auto parameters_of = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {input,    folder_.file("out.ply"), "--config", config,
                                          "--json", folder_.file("r.json"),  "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).exit_code, 0);
    return readJson("r.json");
  };
  const Json from_file = parameters_of({});
  EXPECT_EQ(from_file["preset"], "printed");
  EXPECT_EQ(from_file["parameters"]["triangulation.order"], "first_in_first_out");
  EXPECT_EQ(from_file["parameters"]["triangulation.neighbors"], 18);
  EXPECT_EQ(from_file["parameters"]["refinement.levels"], 1);
  EXPECT_EQ(from_file["levels"].size(), 2u);
  const Json over =
      parameters_of({"-preset", "default", "--refinement.levels=0", "-triangulation.restart", "off"});
  EXPECT_EQ(over["preset"], "default");
  EXPECT_EQ(over["parameters"]["triangulation.order"], "priority");
  EXPECT_EQ(over["parameters"]["triangulation.neighbors"], 18);
  EXPECT_EQ(over["parameters"]["triangulation.restart"], false);
  EXPECT_EQ(over["levels"].size(), 1u);
}

TEST_F(Reconstruct, NoReductionKeepsThePoints) {
  runWell({sphere(), folder_.file("out.ply"), "--no-reduction", "--levels", "0"});
  EXPECT_EQ(readPly("out.ply").faces.size(), static_cast<std::size_t>(2 * kCount - 4));
}

TEST_F(Reconstruct, SameBytesForAnyNumberOfThreads) {
  const std::string input = sphere();
  for (const char* extension : {"ply", "vtk"}) {
    const std::string one = folder_.file(std::string("one.") + extension);
    const std::string two = folder_.file(std::string("two.") + extension);
    runWell({input, one, "--threads", "1"});
    runWell({input, two, "--threads", "2"});
    EXPECT_EQ(readFile(one), readFile(two));
  }
}

TEST_F(Reconstruct, QuietAndOverwriting) {
  const std::string output = folder_.write("out.ply", "old");
  EXPECT_EQ(runWell({sphere(), output, "--quiet"}), "");
  EXPECT_GT(readPly("out.ply").faces.size(), 0u);
  fs::create_symlink("out.ply", folder_.path() / "link.ply");
  runWell({sphere(), folder_.file("link.ply"), "--levels", "0"});
  EXPECT_TRUE(fs::is_symlink(folder_.file("link.ply")));
  EXPECT_LT(readPly("out.ply").faces.size(), 2000u);
}

TEST_F(Reconstruct, HelpListsEveryParameter) {
  const std::string help = runWell({"--help"});
  for (const apps::Parameter& parameter : apps::parameterTable()) {
    EXPECT_NE(help.find("--" + parameter.name + " "), std::string::npos) << parameter.name;
  }
  for (const char* option :
       {"--levels", "--hole-size", "--watertight", "--all-levels", "--no-reduction", "--preset", "--config",
        "--threads", "--quiet", "--json", "--version", "--list-parameters"}) {
    EXPECT_NE(help.find(option), std::string::npos) << option;
  }
  EXPECT_EQ(runWell({"-h"}), help);
  EXPECT_EQ(runWell({"--version"}).rfind("mlsmesh_reconstruct ", 0), 0u);
}

TEST_F(Reconstruct, ParameterPageHasNotDrifted) {
  EXPECT_TRUE(runWell({"--list-parameters=markdown"}) == readFile(MLSMESH_SOURCE_DIR "/docs/parameters.md"))
      << "write it again: mlsmesh_reconstruct --list-parameters=markdown > docs/parameters.md";
}

TEST_F(Reconstruct, ListOfParametersIsAConfig) {
  const std::string list = runWell({"--list-parameters=config", "--preset", "printed", "--levels", "5"});
  const std::string config = folder_.write("all.cfg", list);
  EXPECT_EQ(runWell({"--list-parameters=config", "--config", config}), list);
}

const std::string kLaunchConfigs = MLSMESH_SOURCE_DIR "/launch_configs/reconstruct";

// The names of the launch configs, without extension.
std::set<std::string> launchConfigs() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(kLaunchConfigs)) names.insert(entry.path().stem().string());
  return names;
}

TEST_F(Reconstruct, LaunchConfigsOfPresetsAndModels) {
  for (const std::string name :
       {"default", "paper", "printed", "bunny", "cactus", "cat", "club", "dragon", "horse"}) {
    SCOPED_TRACE(name);
    const std::string preset = apps::findPreset(name) != nullptr ? name : "paper";
    EXPECT_EQ(runWell({"--config", kLaunchConfigs + "/" + name + ".cfg", "--list-parameters=config"}),
              runWell({"--preset", preset, "--list-parameters=config"}));
  }
}

TEST_F(Reconstruct, EveryLaunchConfigRuns) {
  const std::string input = sphere();
  const std::string page = readFile(MLSMESH_SOURCE_DIR "/docs/launch_configs.md");
  for (const std::string& name : launchConfigs()) {
    SCOPED_TRACE(name);
    EXPECT_NE(page.find("`" + name + ".cfg`"), std::string::npos) << "not in docs/launch_configs.md";
    const Outcome outcome =
        run({input, folder_.file("out.ply"), "--config", kLaunchConfigs + "/" + name + ".cfg", "--json",
             folder_.file("r.json"), "--quiet"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json json = readJson("r.json");
    const Json& finest = json["levels"].back();
    EXPECT_EQ(readPly("out.ply").faces.size(), finest["triangles"].get<std::size_t>());
    if (name == "printed") continue;  // which may leave the mesh incomplete
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(finest["components"], 1);
    EXPECT_EQ(finest["border_loops"], 0);
    EXPECT_EQ(finest["genus"], 0);
    EXPECT_EQ(finest["self_intersections"], 0);
  }
}

TEST_F(Reconstruct, LaunchConfigsDoWhatTheySay) {
  const std::string input = sphere();
  const auto with = [&](const std::string& name) {
    runWell({input, folder_.file("out.ply"), "--config", kLaunchConfigs + "/" + name + ".cfg", "--json",
             folder_.file("r.json"), "--quiet"});
    return readJson("r.json");
  };
  const Json usual = with("default");
  const Json preview = with("preview");
  EXPECT_EQ(preview["levels"].size(), 1u);
  EXPECT_LT(2 * preview["representatives"].get<int>(), usual["representatives"].get<int>());
  const Json full = with("full_resolution");
  EXPECT_EQ(full["levels"].size(), 1u);
  EXPECT_EQ(full["levels"][0]["vertices"], kCount);
  for (const std::string name : {"noisy_scan", "rgbd_frame", "terrain"}) {
    EXPECT_EQ(with(name)["levels"].size(), 2u) << name;
  }
  EXPECT_EQ(with("outlier_scan")["parameters"]["outliers.smallest_group"], 50);
  EXPECT_EQ(with("terrain")["parameters"]["hole_size"], 40);
  EXPECT_EQ(with("watertight")["parameters"]["watertight"], true);
}

}  // namespace mlsmesh::test
