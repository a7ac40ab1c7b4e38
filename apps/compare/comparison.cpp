// SPDX-License-Identifier: BSD-3-Clause
#include "compare/comparison.h"

#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/file_bytes.h"
#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "compare/child_process.h"
#include "compare/columns.h"
#include "compare/our_parameters.h"
#include "compare/output_folder.h"
#include "compare/page.h"
#include "compare/report_files.h"
#include "compare/results.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <iostream>
#include <set>

namespace mlsmesh::apps {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastMeasuringSeconds = 600;
constexpr std::uint64_t kLeastMeasuringBytes = std::uint64_t{2} << 30;
constexpr double kDrawingSecondsPerMesh = 300;
constexpr double kPageBytes = 6e6;  // of all pictures together
constexpr double kBytesPerPixel = 0.2;
constexpr double kSmallestSide = 240;  // pixels of a picture
constexpr double kLargestSide = 640;
constexpr int kKindsOfPictures = 3;

/// Letters, digits, '-' and '_' only.
std::string fileNameOf(const fs::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return name.empty() ? "cloud" : name;
}

std::string dateAndTime() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
  return text;
}

std::string signalText(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

/// Throws AppError where a path in it cannot be said in JSON.
std::string textOf(const Json& task) {
  try {
    return task.dump();
  } catch (const Json::type_error&) {
    throw AppError(kExitUsage, "arguments: names of files must be UTF-8; rename them");
  }
}

/// All of a comparison that has a state: what is done, and what the screen shows of it.
class Run {
 public:
  explicit Run(const CompareOptions& options)
      : options_(options), folder_(options.output), bar_(!options.quiet), guard_(progress_) {
    comparison_.limit_seconds = options.limit_seconds;
    comparison_.memory_bytes = options.memory_bytes;
    comparison_.threads = options.threads;
    comparison_.when = dateAndTime();
  }

  void work() {
    for (const CompareInput& input : options_.inputs) survey(input);
    for (std::size_t i = 0; i < comparison_.clouds.size(); ++i) {
      for (const Method* method : options_.methods) addRow(comparison_.clouds[i], *method);
      if (options_.pictures) draw(options_.inputs[i].view, comparison_.clouds[i]);
    }
    writeFiles();
    InterruptGuard::check();
    folder_.commit();
  }

 private:
  /// Runs a worker; null if it left no result, whose reason `outcome` tells.
  Json runTask(Json task, const ChildLimits& limits, const std::string& title, ChildOutcome& outcome) {
    const fs::path result = folder_.scratch("result.json");
    std::error_code ignored;
    fs::remove(result, ignored);
    task["result"] = result.string();
    outcome = runSelf({kWorkerOption, textOf(task)}, limits, folder_.scratch("log.txt"), [&](double seconds) {
      InterruptGuard::check();
      bar_.draw(title + " " + std::to_string(static_cast<int>(seconds)) + " s", share());
    });
    InterruptGuard::check();
    if (outcome.exit_code != 0 || !fs::exists(result)) return nullptr;
    return Json::parse(readBytes(result));
  }

  /// Why a worker left no result.
  std::string reasonOf(const ChildOutcome& outcome, const ChildLimits& limits) const {
    if (outcome.timed_out) return "not ended after " + numberText(limits.seconds, 6) + " s";
    std::string reason =
        outcome.signal != 0 ? signalText(outcome.signal) : "exit code " + std::to_string(outcome.exit_code);
    if (!outcome.last_words.empty()) reason += ": " + outcome.last_words;
    return reason;
  }

  static void throwIfError(const Json& result) {
    if (result.contains("error"))
      throw AppError(result.at("exit_code").get<int>(), result.at("error").get<std::string>());
  }

  double share() const {
    const double all = static_cast<double>(options_.inputs.size() * options_.methods.size());
    return static_cast<double>(rows_) / all;
  }

  void survey(const CompareInput& input) {
    ChildOutcome outcome;
    const Json result = runTask({{"kind", "survey"},
                                 {"cloud", input.cloud.string()},
                                 {"truth", input.truth.string()},
                                 {"threads", 0}},
                                {}, "reading", outcome);
    if (result.is_null()) throw fileError(input.cloud.string(), "cannot be read: " + reasonOf(outcome, {}));
    throwIfError(result);
    CloudResult cloud;
    cloud.name = fileNameOf(input.cloud);
    for (int number = 2; !names_.insert(cloud.name).second; ++number)
      cloud.name = fileNameOf(input.cloud) + "_" + std::to_string(number);
    cloud.file = input.cloud;
    cloud.truth = input.truth;
    cloud.points = result.at("points");
    cloud.finite = result.at("finite");
    cloud.width = result.at("width");
    cloud.height = result.at("height");
    cloud.spacing = result.at("spacing");
    cloud.diagonal = result.at("diagonal");
    comparison_.clouds.push_back(cloud);
  }

  void addRow(CloudResult& cloud, const Method& method) {
    Row row;
    row.method = &method;
    row.parameters =
        (takesParameters(method) ? parametersText(options_.ours) + ", " : "") + method.parameters;
    const std::string stem = "meshes/" + cloud.name + "/" + method.name;
    const fs::path mesh = folder_.draft(stem + ".ply");
    reconstruct(cloud, mesh, row);
    if (row.status == RowStatus::Done) {
      row.mesh_file = stem + ".ply";
      measure(cloud, mesh, row);
    } else {
      for (const char* extension : {".ply", ".vtk"}) folder_.discard(stem + extension);
    }
    ++rows_;
    tell(cloud, row);
    cloud.rows.push_back(std::move(row));
  }

  void reconstruct(const CloudResult& cloud, const fs::path& mesh, Row& row) {
    const ChildLimits limits{options_.limit_seconds, options_.memory_bytes};
    ChildOutcome outcome;
    const Json result = runTask({{"kind", "reconstruct"},
                                 {"cloud", cloud.file.string()},
                                 {"method", row.method->name},
                                 {"threads", options_.threads},
                                 {"parameters", parametersJson(options_.ours)},
                                 {"mesh", mesh.string()}},
                                limits, row.method->name, outcome);
    row.wall_seconds = outcome.wall_seconds;
    row.user_seconds = outcome.user_seconds;
    row.system_seconds = outcome.system_seconds;
    row.peak_bytes = outcome.peak_bytes;
    if (result.is_null()) {
      row.status = outcome.timed_out ? RowStatus::OverTime : RowStatus::Crashed;
      row.reason = reasonOf(outcome, limits);
      return;
    }
    throwIfError(result);
    row.status = statusFromName(result.at("status"));
    row.reason = result.at("reason");
    if (row.status == RowStatus::OverMemory)
      row.reason = "wanted more than " + numberText(std::round(toMegabytes(limits.memory_bytes)), 9) + " MB";
    row.cpu_seconds = result.at("cpu_seconds");
    row.peak_bytes = result.at("peak_bytes");
    for (const Json& stage : result.at("stages"))
      row.stages.push_back({stage.at("name"), stage.at("seconds")});
  }

  void measure(const CloudResult& cloud, const fs::path& mesh, Row& row) {
    const ChildLimits limits{std::max(options_.limit_seconds, kLeastMeasuringSeconds),
                             std::max(options_.memory_bytes, kLeastMeasuringBytes)};
    ChildOutcome outcome;
    const Json result = runTask({{"kind", "measure"},
                                 {"mesh", mesh.string()},
                                 {"cloud", cloud.file.string()},
                                 {"truth", cloud.truth.string()},
                                 {"threads", 0}},
                                limits, row.method->name + ": measured", outcome);
    if (result.is_null())
      row.reason = "not measured: " + reasonOf(outcome, limits);
    else if (result.contains("error"))
      row.reason = "not measured: " + result.at("error").get<std::string>();
    else
      row.report = result;
  }

  /// Pixels a side that keep the page small, however many pictures there are.
  int pictureSide() const {
    const double pictures =
        static_cast<double>(options_.inputs.size() * (2 + kKindsOfPictures * options_.methods.size()));
    return static_cast<int>(
        std::clamp(std::sqrt(kPageBytes / (pictures * kBytesPerPixel)), kSmallestSide, kLargestSide));
  }

  void draw(const std::string& view, CloudResult& cloud) {
    std::vector<Row*> drawn;
    Json meshes = Json::array();
    for (Row& row : cloud.rows) {
      if (row.mesh_file.empty()) continue;
      meshes.push_back(folder_.draft(row.mesh_file).string());
      drawn.push_back(&row);
    }
    const fs::path pictures = folder_.scratch(cloud.name);
    fs::create_directories(pictures);
    const ChildLimits limits{kDrawingSecondsPerMesh * static_cast<double>(1 + drawn.size()), 0};
    ChildOutcome outcome;
    const Json result = runTask({{"kind", "draw"},
                                 {"cloud", cloud.file.string()},
                                 {"truth", cloud.truth.string()},
                                 {"spacing", cloud.spacing > 0 ? cloud.spacing : 1},
                                 {"side", pictureSide()},
                                 {"view", view},
                                 {"up", options_.up},
                                 {"folder", pictures.string()},
                                 {"meshes", meshes}},
                                limits, "pictures", outcome);
    if (result.is_null() || result.contains("error")) {
      bar_.wipe();
      printWarning(kCompareProgram, "no pictures of " + cloud.name + ": " +
                                        (result.is_null() ? reasonOf(outcome, limits)
                                                          : result.at("error").get<std::string>()));
      return;
    }
    cloud.cloud_picture = result.at("cloud").get<std::string>();
    cloud.truth_picture = result.at("truth").get<std::string>();
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const Json& files = result.at("meshes").at(i);
      drawn[i]->pictures = {files.at("surface").get<std::string>(),
                            files.at("mesh_to_cloud").get<std::string>(),
                            files.at("cloud_to_mesh").get<std::string>()};
    }
  }

  void tell(const CloudResult& cloud, const Row& row) {
    if (options_.quiet) return;
    bar_.wipe();
    std::cout << rowLine(cloud, row) << std::endl;
  }

  void writeDraft(const std::string& name, const std::string& content) {
    writeFile(folder_.draft(name), content, options_.output / name);
  }

  void writeFiles() {
    bar_.draw("report", 1);
    writeDraft("results.json", resultsJson(comparison_));
    writeDraft("results.csv", resultsCsv(comparison_));
    writeDraft("report.md", reportMarkdown(comparison_));
    writeDraft("report.html", reportPage(comparison_));
  }

  const CompareOptions& options_;
  OutputFolder folder_;
  ProgressBar bar_;
  Progress progress_;
  InterruptGuard guard_;
  Comparison comparison_;
  std::set<std::string> names_;
  std::size_t rows_ = 0;
};

}  // namespace

void compare(const CompareOptions& options) {
  Run(options).work();
  if (!options.quiet) std::cout << "see " << (options.output / "report.html").string() << std::endl;
}

}  // namespace mlsmesh::apps
