// SPDX-License-Identifier: BSD-3-Clause
#include "common/interrupt.h"

#include "common/app_error.h"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>

namespace mlsmesh::apps {

namespace {

constexpr std::array<int, 2> kSignals = {SIGINT, SIGTERM};

// What a handler may read: lock-free atomics, and memory that is set before and freed after they point to it.
std::array<std::atomic<const char*>, 64> g_files{};
std::array<char, 64> g_program{};
pthread_t g_first_thread;
pid_t g_process = 0;
std::atomic<bool> g_is_in_place{false};
volatile std::sig_atomic_t g_signal = 0;

void print(const char* text) {
  const ssize_t ignored = write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(ignored);
}

/// Only async-signal-safe calls. On the first thread, so that no file appears meanwhile.
void endNow(int number) {
  if (getpid() != g_process) _exit(128 + number);  // a child before it has become another program
  if (pthread_equal(pthread_self(), g_first_thread) == 0) {
    pthread_kill(g_first_thread, number);
    return;
  }
  for (const std::atomic<const char*>& file : g_files) {
    const char* const name = file;
    if (name != nullptr) unlink(name);
  }
  if (isatty(STDERR_FILENO) != 0) print("\n");
  print(g_program.data());
  print(g_is_in_place ? ": interrupted\n" : ": interrupted; no file was written\n");
  _exit(128 + number);
}

void keepSignal(int number) {
  g_signal = number;
}

void handle(void (*handler)(int), int flags) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  for (const int number : kSignals) sigaddset(&action.sa_mask, number);
  for (const int number : kSignals) sigaction(number, &action, nullptr);
}

}  // namespace

void endOnInterrupt(const std::string& program) {
  program.copy(g_program.data(), g_program.size() - 1);
  g_first_thread = pthread_self();
  g_process = getpid();
  handle(endNow, SA_RESTART);
  std::signal(SIGXFSZ, SIG_IGN);
}

RemovedOnInterrupt::RemovedOnInterrupt(const std::string& file) : place_(-1) {
  char* const copy = strdup(file.c_str());
  if (copy == nullptr) throw std::bad_alloc();
  for (std::size_t i = 0; i < g_files.size(); ++i) {
    const char* none = nullptr;
    if (!g_files[i].compare_exchange_strong(none, copy)) continue;
    place_ = static_cast<int>(i);
    return;
  }
  std::free(copy);
}

RemovedOnInterrupt::RemovedOnInterrupt(RemovedOnInterrupt&& other) noexcept : place_(other.place_) {
  other.place_ = -1;
}

RemovedOnInterrupt::~RemovedOnInterrupt() {
  if (place_ < 0) return;
  const InterruptsWait wait;  // a handler on this thread has done, or has yet to look
  std::free(const_cast<char*>(g_files[static_cast<std::size_t>(place_)].exchange(nullptr)));
}

InterruptsWait::InterruptsWait() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : kSignals) sigaddset(&signals, number);
  pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

InterruptsWait::~InterruptsWait() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void InterruptsWait::inPlace() {
  g_is_in_place = true;
}

InterruptGuard::InterruptGuard() {
  handle(keepSignal, static_cast<int>(SA_RESETHAND));
}

InterruptGuard::~InterruptGuard() {
  handle(endNow, SA_RESTART);
}

void InterruptGuard::check() {
  if (g_signal != 0) throw AppError(128 + g_signal, "interrupted; no file was written");
}

}  // namespace mlsmesh::apps
