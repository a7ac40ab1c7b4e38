// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <string>

namespace mlsmesh::apps {

/// From now on SIGINT and SIGTERM end the program at once, wherever it is, with the exit code 128 + signal
/// and one line on stderr that begins with its name; files named by RemovedOnInterrupt go first. Writing
/// beyond a file size limit becomes an error instead of a signal. To be called by the first thread, which
/// alone may make or rename files.
void endOnInterrupt(const std::string& program);

/// While it lives, an interrupt removes the file of this name, whether it exists by then or not. Files beyond
/// the 64th at a time are not removed.
class RemovedOnInterrupt {
 public:
  explicit RemovedOnInterrupt(const std::string& file);
  ~RemovedOnInterrupt();
  RemovedOnInterrupt(RemovedOnInterrupt&& other) noexcept;
  RemovedOnInterrupt& operator=(RemovedOnInterrupt&&) = delete;

 private:
  int place_;
};

/// While it lives, interrupts wait. They are told that files are in place if inPlace() was called.
class InterruptsWait {
 public:
  InterruptsWait();
  ~InterruptsWait();
  InterruptsWait(const InterruptsWait&) = delete;
  InterruptsWait& operator=(const InterruptsWait&) = delete;

  void inPlace();

 private:
  sigset_t before_;
};

/// While it lives, the first SIGINT or SIGTERM is kept for check() instead; a second one ends the program at
/// once. For programs that have more to put away than files. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Throws AppError with the exit code 128 + signal if one has come.
  static void check();
};

}  // namespace mlsmesh::apps
