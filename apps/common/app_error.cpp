// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"

#include <csignal>
#include <iostream>
#include <new>

namespace mlsmesh::apps {

namespace {

constexpr std::size_t kLongestLine = 400;

int fail(const std::string& program, int exit_code, const std::string& message) {
  std::cerr << program << ": " << oneLine(message) << std::endl;
  return exit_code;
}

}  // namespace

AppError fileError(const std::string& file, const std::string& what_and_remedy) {
  return {kExitFailure, file + ": " + what_and_remedy};
}

AppError damagedFile(const std::string& file, const std::string& format) {
  return fileError(file, "is not a whole " + format + " file (cut off or damaged); copy or write it again");
}

std::string oneLine(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool blank = static_cast<unsigned char>(c) <= ' ' || c == '\x7f';
    if (!blank) {
      line.push_back(c);
    } else if (!line.empty() && line.back() != ' ') {
      line.push_back(' ');
    }
    if (line.size() == kLongestLine) return line + " ...";
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

void printWarning(const std::string& program, const std::string& message) {
  std::cerr << program << ": warning: " << oneLine(message) << std::endl;
}

int runProgram(const std::string& program, const std::function<int()>& work) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file larger than allowed is an error of writing, as on a full disk
  try {
    return work();
  } catch (const AppError& error) {
    return fail(program, error.exitCode(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(program, kExitFailure, "out of memory; use a smaller cloud or fewer levels");
  } catch (const std::exception& error) {
    return fail(program, kExitFailure, std::string("internal error: ") + error.what() + "; please report it");
  }
}

}  // namespace mlsmesh::apps
