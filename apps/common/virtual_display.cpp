// SPDX-License-Identifier: BSD-3-Clause
#include "common/virtual_display.h"

#include "common/app_error.h"

#include <X11/Xlib.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>

namespace mlsmesh::apps {
namespace {

constexpr int kStartTimeoutMs = 30000;

AppError displayError(const std::string& what) {
  return {kExitFailure, "DISPLAY: no X display to draw on, and " + what};
}

/// In the child process: becomes Xvfb, which writes the number of its display to `number_fd`. Only
/// async-signal-safe calls.
[[noreturn]] void becomeXvfb(int number_fd, const char* number_fd_text) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int null_fd = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null_fd, stream);
  fcntl(number_fd, F_SETFD, 0);
  execlp("Xvfb", "Xvfb", "-displayfd", number_fd_text, "-screen", "0", "1280x1024x24", "-nolisten", "tcp",
         "-noreset", static_cast<char*>(nullptr));
  _exit(127);
}

/// Reads the number of the display, which ends with a newline; empty if the server ended, or is not ready in
/// time.
std::string readDisplayNumber(int fd) {
  std::string text;
  for (pollfd wanted{fd, POLLIN, 0}; poll(&wanted, 1, kStartTimeoutMs) > 0;) {
    char byte = 0;
    const ssize_t got = read(fd, &byte, 1);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return {};
    if (byte == '\n') return text;
    text += byte;
  }
  return {};
}

}  // namespace

bool isDisplayUsable() {
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return false;
  int opcode = 0;
  int event = 0;
  int error = 0;
  const bool has_opengl = XQueryExtension(display, "GLX", &opcode, &event, &error) != 0;
  XCloseDisplay(display);
  return has_opengl;
}

VirtualDisplay::VirtualDisplay() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw displayError("no pipe to a virtual one could be opened");
  const std::string number_fd_text = std::to_string(ends[1]);
  server_ = fork();
  if (server_ == 0) becomeXvfb(ends[1], number_fd_text.c_str());
  close(ends[1]);
  const std::string number = server_ > 0 ? readDisplayNumber(ends[0]) : std::string();
  close(ends[0]);
  if (!number.empty()) setenv("DISPLAY", (":" + number).c_str(), 1);
  if (!number.empty() && isDisplayUsable()) return;
  stop();
  throw displayError("a virtual one did not start; install it: apt-get install xvfb libgl1-mesa-dri");
}

VirtualDisplay::~VirtualDisplay() {
  stop();
}

void VirtualDisplay::stop() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  while (waitpid(server_, nullptr, 0) < 0 && errno == EINTR) {
  }
  server_ = -1;
}

}  // namespace mlsmesh::apps
