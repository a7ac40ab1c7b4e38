// SPDX-License-Identifier: BSD-3-Clause
#include "common/interrupt.h"

#include "common/app_error.h"

#include <csignal>

namespace mlsmesh::apps {

namespace {

Progress* g_progress = nullptr;
volatile std::sig_atomic_t g_signal = 0;

/// Progress::cancel() sets an atomic flag and nothing else: safe here.
void cancelOnSignal(int number) {
  g_signal = number;
  if (g_progress != nullptr) g_progress->cancel();
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(number, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard(const Progress& progress) : progress_(progress) {
  g_progress = &progress_;
  handle(SIGINT, cancelOnSignal);
  handle(SIGTERM, cancelOnSignal);
  std::signal(SIGXFSZ, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
  handle(SIGINT, SIG_DFL);
  handle(SIGTERM, SIG_DFL);
  g_progress = nullptr;
}

void InterruptGuard::check() {
  if (g_signal != 0) throw AppError(128 + g_signal, "interrupted; no file was written");
}

}  // namespace mlsmesh::apps
