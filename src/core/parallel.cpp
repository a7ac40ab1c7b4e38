// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/parallel.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "mlsmesh/core/failure.h"

namespace mlsmesh::core {

namespace {

Failure cancelled() {
  return {StatusCode::Cancelled, "cancelled through the progress handle; reset() it before another run"};
}

/// The state that the threads of one loop share.
class BlockLoop {
 public:
  using Body = std::function<void(std::size_t first, std::size_t last)>;

  BlockLoop(const Progress& progress, std::size_t count, std::size_t block, const Body& body)
      : progress_(progress), count_(count), block_(block), failed_block_(blockCount()), body_(body) {}

  std::size_t blockCount() const { return (count_ + block_ - 1) / block_; }

  /// Runs a block unless an earlier one failed or the loop was cancelled; keeps what it throws for finish().
  void run(std::size_t index, bool on_calling_thread) noexcept {
    if (index > failed_block_) return;
    if (progress_.cancelled()) {
      cancelled_ = true;
      return;
    }
    try {
      body_(index * block_, std::min(count_, (index + 1) * block_));
      const std::size_t done = ++done_;
      if (on_calling_thread) progress_.advance(static_cast<double>(done) / static_cast<double>(blockCount()));
    } catch (...) {
      keepFirst(index, std::current_exception());
    }
  }

  void finish() {
    if (error_) std::rethrow_exception(error_);
    if (cancelled_) throw cancelled();
    progress_.advance(1.0);
  }

 private:
  void keepFirst(std::size_t index, std::exception_ptr error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (index >= failed_block_) return;
    failed_block_ = index;
    error_ = std::move(error);
  }

  Progress progress_;
  const std::size_t count_;
  const std::size_t block_;
  std::atomic<std::size_t> done_{0};
  std::atomic<std::size_t> failed_block_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
  const Body& body_;
};

/// Threads that wait for one another, to see how many there can be at a time.
class Muster {
 public:
  ~Muster() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends_ = true;
    }
    end_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  /// One more; false if the system has no room for it.
  bool add() {
    try {
      threads_.emplace_back([this] {
        std::unique_lock<std::mutex> lock(mutex_);
        end_.wait(lock, [this] { return ends_; });
      });
      return true;
    } catch (const std::system_error&) {
      return false;
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable end_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

/// `wanted`, or as many as can be started: OpenMP ends the process where it cannot start a thread. Those that
/// the calling thread has had before are its own.
int startable(int wanted) {
  thread_local int had = 1;
  if (wanted <= had) return wanted;
  int can_be = 1;
  {
    Muster muster;
    while (can_be < wanted && muster.add()) ++can_be;
  }
  if (can_be == wanted) had = wanted;
  return std::max(had, can_be);
}

}  // namespace

void Context::checkCancelled() const {
  if (progress.cancelled()) throw cancelled();
}

int threadCount(int setting) {
  return setting > 0 ? setting : omp_get_max_threads();
}

void parallelBlocks(const Context& context, std::size_t count, std::size_t block,
                    const std::function<void(std::size_t first, std::size_t last)>& body) {
  context.checkCancelled();
  if (count == 0) return;
  BlockLoop loop(context.progress, count, std::max<std::size_t>(block, 1), body);
  const std::size_t blocks = loop.blockCount();
  // Always as many threads, so that they stay: none is started anew when memory has become short.
  // NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): the pragma reads it
  const int threads = blocks > 1 ? startable(threadCount(context.threads)) : 1;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t index = 0; index < blocks; ++index) loop.run(index, omp_get_thread_num() == 0);
  loop.finish();
}

}  // namespace mlsmesh::core
