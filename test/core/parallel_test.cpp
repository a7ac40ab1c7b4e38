// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "mlsmesh/core/failure.h"

namespace mlsmesh::core {
namespace {

Context withThreads(int threads) {
  Context context;
  context.threads = threads;
  return context;
}

TEST(ParallelBlocks, CoverEveryItemOnce) {
  for (const int threads : {1, 2, 8})
    for (const std::size_t count : {0, 1, 9, 10, 11, 1000})
      for (const std::size_t block : {1, 10, 5000}) {
        std::vector<std::atomic<int>> visits(count);
        parallelBlocks(withThreads(threads), count, block, [&](std::size_t first, std::size_t last) {
          EXPECT_LT(first, last);
          EXPECT_LE(last - first, block);
          for (std::size_t i = first; i < last; ++i) ++visits[i];
        });
        for (const auto& visited : visits) ASSERT_EQ(visited, 1);
      }
}

TEST(ParallelBlocks, ThrowWhatTheFirstFailingBlockThrew) {
  for (const int threads : {1, 2, 8}) {
    for (int round = 0; round < 20; ++round) {
      try {
        parallelBlocks(withThreads(threads), 100, 1, [&](std::size_t first, std::size_t) {
          const bool late = round % 2 == 0 ? first == 13 : first > 13;
          if (late) std::this_thread::sleep_for(std::chrono::milliseconds(2));
          if (first >= 13) throw std::runtime_error("block " + std::to_string(first));
        });
        FAIL() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        ASSERT_STREQ(error.what(), "block 13");
      }
    }
  }
}

TEST(ParallelBlocks, KeepTheTypeOfTheException) {
  const auto throw_failure = [](std::size_t, std::size_t) { throw Failure(StatusCode::InvalidMesh, "why"); };
  const Status status = guarded([&] { parallelBlocks(withThreads(4), 10, 1, throw_failure); });
  EXPECT_EQ(status.code, StatusCode::InvalidMesh);
  EXPECT_EQ(status.message, "why");
}

TEST(ParallelBlocks, RunInsideOneAnother) {
  std::atomic<int> runs{0};
  parallelBlocks(withThreads(2), 4, 1, [&](std::size_t, std::size_t) {
    parallelBlocks(withThreads(2), 8, 1, [&](std::size_t, std::size_t) { ++runs; });
  });
  EXPECT_EQ(runs, 32);
}

TEST(ParallelBlocks, StopWhenAnotherThreadCancels) {
  for (const int threads : {1, 4}) {
    const Context context = withThreads(threads);
    std::atomic<int> blocks{0};
    std::thread canceller([&] {
      while (blocks < 3) std::this_thread::yield();
      Progress(context.progress).cancel();
    });
    const Status status = guarded([&] {
      parallelBlocks(context, 1000000, 1, [&](std::size_t, std::size_t) {
        ++blocks;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      });
    });
    canceller.join();
    EXPECT_EQ(status.code, StatusCode::Cancelled);
    EXPECT_LT(blocks, 1000000);
  }
}

TEST(ParallelBlocks, DoNotStartWhenAlreadyCancelled) {
  Context context;
  context.progress.cancel();
  bool ran = false;
  EXPECT_THROW(parallelBlocks(context, 10, 1, [&](std::size_t, std::size_t) { ran = true; }), Failure);
  EXPECT_FALSE(ran);
}

TEST(ThreadCount, IsTheSettingOrAll) {
  EXPECT_EQ(threadCount(3), 3);
  EXPECT_GE(threadCount(0), 1);
}

struct Report {
  std::string stage;
  double fraction;
};

/// Records every call, and that it came from the thread that made the recorder.
class Recorder {
 public:
  Progress progress() {
    return Progress([this](const std::string& stage, double fraction) {
      same_thread_ = same_thread_ && std::this_thread::get_id() == owner_;
      reports_.push_back({stage, fraction});
    });
  }
  const std::vector<Report>& reports() const { return reports_; }
  bool sameThread() const { return same_thread_; }

 private:
  const std::thread::id owner_ = std::this_thread::get_id();
  bool same_thread_ = true;
  std::vector<Report> reports_;
};

TEST(Progress, IsReportedInOrderFromTheCallingThreadAboutAHundredTimesAStage) {
  Recorder recorder;
  Context context = withThreads(4);
  context.progress = recorder.progress();
  context.progress.begin();
  for (const auto& [stage, end] : {std::pair("one", 0.25), std::pair("two", 0.5), std::pair("three", 1.0)}) {
    context.progress.enterStage(stage, end);
    parallelBlocks(context, 5000, 1, [](std::size_t, std::size_t) { std::this_thread::yield(); });
    EXPECT_DOUBLE_EQ(context.progress.fraction(), end);
  }
  EXPECT_TRUE(recorder.sameThread());
  EXPECT_LE(recorder.reports().size(), 3u * 102);
  double before = 0;
  for (const Report& report : recorder.reports()) {
    EXPECT_GE(report.fraction, before);
    before = report.fraction;
  }
  EXPECT_EQ(before, 1.0);
  EXPECT_EQ(recorder.reports().front().stage, "one");
  EXPECT_EQ(recorder.reports().back().stage, "three");
}

TEST(Progress, NeverFalls) {
  Progress progress;
  progress.begin();
  progress.enterStage("stage", 0.5);
  progress.advance(0.8);
  EXPECT_DOUBLE_EQ(progress.fraction(), 0.4);
  for (const double share : {0.1, -3.0, std::numeric_limits<double>::quiet_NaN()}) progress.advance(share);
  EXPECT_DOUBLE_EQ(progress.fraction(), 0.4);
  progress.enterStage("next", 0.3);
  EXPECT_DOUBLE_EQ(progress.fraction(), 0.5);
  progress.enterStage("last", 7);
  progress.advance(9);
  EXPECT_DOUBLE_EQ(progress.fraction(), 1.0);
}

TEST(Progress, StartsAgain) {
  Progress progress;
  progress.enterStage("stage", 1);
  progress.advance(1);
  progress.cancel();
  progress.begin();
  EXPECT_EQ(progress.fraction(), 0);
  EXPECT_TRUE(progress.cancelled()) << "a new run must not forget that it was asked to stop";
  progress.reset();
  EXPECT_FALSE(progress.cancelled());
}

TEST(Progress, CopiesShareOneState) {
  Progress progress;
  Progress copy = progress;
  copy.cancel();
  progress.enterStage("stage", 0.5);
  progress.advance(1);
  EXPECT_TRUE(progress.cancelled());
  EXPECT_EQ(copy.fraction(), 0.5);
}

TEST(Progress, CanBeCancelledFromItsCallback) {
  Progress* handle = nullptr;
  Context context = withThreads(1);
  context.progress = Progress([&](const std::string&, double fraction) {
    if (fraction > 0.2) handle->cancel();
  });
  handle = &context.progress;
  context.progress.enterStage("stage", 1);
  EXPECT_THROW(parallelBlocks(context, 100000, 1, [](std::size_t, std::size_t) {}), Failure);
  EXPECT_LT(context.progress.fraction(), 1);
}

TEST(Guarded, TurnsExceptionsIntoStatus) {
  EXPECT_TRUE(guarded([] {}).ok());
  EXPECT_EQ(guarded([] { throw Failure(StatusCode::NoMesh, "none"); }).code, StatusCode::NoMesh);
  EXPECT_EQ(guarded([] { throw std::bad_alloc(); }).code, StatusCode::OutOfMemory);
  EXPECT_EQ(guarded([] { throw std::length_error("long"); }).code, StatusCode::OutOfMemory);
  EXPECT_EQ(guarded([] { throw 7; }).code, StatusCode::Internal);
  const Status status = guarded([] { throw std::logic_error("culprit"); });
  EXPECT_EQ(status.code, StatusCode::Internal);
  EXPECT_NE(status.message.find("culprit"), std::string::npos);
}

TEST(StatusName, IsDifferentForEveryCode) {
  std::set<std::string> names;
  const int codes = static_cast<int>(StatusCode::Internal) + 1;
  for (int code = 0; code < codes; ++code) names.insert(name(static_cast<StatusCode>(code)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(codes));
  EXPECT_EQ(names.count("Unknown"), 0u);
}

}  // namespace
}  // namespace mlsmesh::core
