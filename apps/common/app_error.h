// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace mlsmesh::apps {

constexpr int kExitOk = 0;
constexpr int kExitFailure = 1;  ///< an input file, an output file or the computation
constexpr int kExitUsage = 2;    ///< an option, a parameter or a config file

/// What ends a program: one line that names the culprit and the remedy, and the exit code.
class AppError : public std::runtime_error {
 public:
  AppError(int exit_code, const std::string& message) : std::runtime_error(message), exit_code_(exit_code) {}
  int exitCode() const { return exit_code_; }

 private:
  int exit_code_;
};

/// An error of a file, "FILE: what is wrong; remedy", with kExitFailure.
AppError fileError(const std::string& file, const std::string& what_and_remedy);
/// That of a file which ends too early or does not hold what its header says.
AppError damagedFile(const std::string& file, const std::string& format);

/// `text` on one line: control characters become spaces, runs of spaces one, and at most 400 characters are
/// kept.
std::string oneLine(const std::string& text);

/// Prints "PROGRAM: warning: MESSAGE" as one line on stderr.
void printWarning(const std::string& program, const std::string& message);

/// Runs `work` and returns its exit code; what it throws becomes exactly one line "PROGRAM: MESSAGE" on
/// stderr and the matching exit code. SIGINT and SIGTERM end it as endOnInterrupt says.
int runProgram(const std::string& program, const std::function<int()>& work);

}  // namespace mlsmesh::apps
