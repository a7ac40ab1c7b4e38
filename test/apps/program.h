// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::test {

/// What a program left behind: its exit code (128 + signal if one ended it), and all it printed.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// A program that runs; what it prints goes to files in `folder`.
class Program {
 public:
  /// `prepare` is called in the new process before the program starts; false ends it with exit code 126.
  Program(const std::string& executable, const std::vector<std::string>& arguments,
          const std::filesystem::path& folder, const std::function<bool()>& prepare = nullptr);

  pid_t id() const { return id_; }
  /// Waits for its end, at most two minutes; then it is killed.
  Outcome wait();

 private:
  pid_t id_;
  std::filesystem::path out_;
  std::filesystem::path err_;
};

/// A folder of its own, removed with all that is in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Path of a file in it.
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& content) const;
  /// Names of what is in it, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string readFile(const std::filesystem::path& file);

}  // namespace mlsmesh::test
