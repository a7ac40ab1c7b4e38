// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace mlsmesh::test {

namespace fs = std::filesystem;

namespace {

void redirect(int descriptor, const fs::path& file) {
  const int opened = open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0666);
  dup2(opened, descriptor);
  close(opened);
}

int exitCodeOf(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Program::Program(const std::string& executable, const std::vector<std::string>& arguments,
                 const fs::path& folder, const std::function<bool()>& prepare)
    : id_(0), out_(folder / "stdout.txt"), err_(folder / "stderr.txt") {
  std::vector<char*> words = {const_cast<char*>(executable.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  id_ = fork();
  if (id_ < 0) throw std::runtime_error("cannot start " + executable);
  if (id_ > 0) return;
  redirect(STDOUT_FILENO, out_);
  redirect(STDERR_FILENO, err_);
  if (prepare && !prepare()) _exit(126);
  execv(executable.c_str(), words.data());
  _exit(127);
}

Outcome Program::wait() {
  Outcome outcome;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  int status = 0;
  while (waitpid(id_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) kill(id_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  outcome.exit_code = exitCodeOf(status);
  outcome.out = readFile(out_);
  outcome.err = readFile(err_);
  fs::remove(out_);
  fs::remove(err_);
  return outcome;
}

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> counter{0};
  path_ = fs::temp_directory_path() /
          ("mlsmesh-test-" + std::to_string(getpid()) + "-" + std::to_string(counter++));
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
  std::ofstream(path_ / name, std::ios::binary) << content;
  return file(name);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string readFile(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace mlsmesh::test
