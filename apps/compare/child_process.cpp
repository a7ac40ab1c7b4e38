// SPDX-License-Identifier: BSD-3-Clause
#include "compare/child_process.h"

#include "common/app_error.h"
#include "compare/stage_clock.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <fstream>

namespace mlsmesh::apps {
namespace {

constexpr long kPollNanoseconds = 2'000'000;
constexpr double kTellSeconds = 0.1;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

void setLimit(__rlimit_resource resource, std::uint64_t value) {
  const rlimit limit{value, value};
  setrlimit(resource, &limit);
}

/// In the new process. Only async-signal-safe calls.
[[noreturn]] void become(char* const* words, const ChildLimits& limits, int log, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(log, stream);
  setLimit(RLIMIT_CORE, 0);
  if (limits.memory_bytes > 0) setLimit(RLIMIT_DATA, limits.memory_bytes);
  execv("/proc/self/exe", words);
  _exit(127);
}

/// Kills the process when it goes out of scope before its end was seen.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (ended_) return;
    kill();
    rusage usage{};
    int status = 0;
    while (wait4(id_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void kill() const { ::kill(id_, SIGKILL); }
  /// Whether it has ended; then `outcome` gets how.
  bool hasEnded(ChildOutcome& outcome) {
    rusage usage{};
    int status = 0;
    if (wait4(id_, &status, WNOHANG, &usage) != id_) return false;
    ended_ = true;
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.user_seconds = seconds(usage.ru_utime);
    outcome.system_seconds = seconds(usage.ru_stime);
    outcome.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return true;
  }

 private:
  pid_t id_;
  bool ended_ = false;
};

std::string lastLine(const std::filesystem::path& log) {
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!oneLine(line).empty()) last = oneLine(line);
  return last;
}

pid_t start(const std::vector<std::string>& arguments, const ChildLimits& limits,
            const std::filesystem::path& log) {
  std::vector<char*> words = {const_cast<char*>("mlsmesh_compare")};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const int file = open(log.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) throw fileError(log.string(), "cannot be written; choose another folder");
  const pid_t parent = getpid();
  const pid_t id = fork();
  if (id == 0) become(words.data(), limits, file, parent);
  close(file);
  if (id < 0) throw AppError(kExitFailure, "no process could be started; are there too many?");
  return id;
}

}  // namespace

ChildOutcome runSelf(const std::vector<std::string>& arguments, const ChildLimits& limits,
                     const std::filesystem::path& log, const std::function<void(double)>& keep_on) {
  ChildOutcome outcome;
  const double begin = wallSeconds();
  Child child(start(arguments, limits, log));
  for (double told = 0; !child.hasEnded(outcome);) {
    const double so_far = wallSeconds() - begin;
    if (limits.seconds > 0 && so_far > limits.seconds && !outcome.timed_out) {
      outcome.timed_out = true;
      child.kill();
    }
    if (so_far - told >= kTellSeconds) {
      told = so_far;
      keep_on(so_far);
    }
    const timespec pause{0, kPollNanoseconds};
    nanosleep(&pause, nullptr);
  }
  outcome.wall_seconds = wallSeconds() - begin;
  outcome.last_words = lastLine(log);
  return outcome;
}

}  // namespace mlsmesh::apps
