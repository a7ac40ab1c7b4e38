// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/detail/cloud.h"
#include "mlsmesh/pcl_search.h"
#include "mlsmesh/progress.h"
#include "mlsmesh/status.h"

#include <pcl/pcl_base.h>
#include <pcl/search/search.h>

#include <memory>
#include <utility>

namespace mlsmesh::detail {

/// What every class of the PCL face has beside its PCL base: the outcome of its verb, threads, and a handle
/// on the run. Not copyable, because a copy of pcl::PCLBase shares its list of indices with the original. One
/// object serves one thread at a time; different objects are independent.
template <typename Base>
class Step : public Base {
 public:
  Step(const Step&) = delete;
  Step& operator=(const Step&) = delete;

  /// Outcome of the last verb; Ok before the first. Verbs throw nothing: what went wrong is told here, and
  /// their outputs are then empty (width = height = 0, no data, no polygons).
  const Status& status() const { return status_; }

  /// Threads to use, 0 = all (default). The result never depends on it. A negative number makes the verb fail
  /// with InvalidParameter.
  void setNumberOfThreads(int threads) { threads_ = threads; }
  int getNumberOfThreads() const { return threads_; }

  /// The handle through which another thread may watch or cancel the verb. Copies of a handle share its
  /// state.
  void setProgress(const Progress& progress) { progress_ = progress; }
  const Progress& progress() const { return progress_; }

 protected:
  using PointType = typename Base::PointCloud::PointType;
  using SearchPtr = typename pcl::search::Search<PointType>::Ptr;

  Step() = default;

  /// Calls work(core::Context&) and leaves its outcome and its warnings in status(). Throws nothing. Unless
  /// that is Ok, what work() has made is to be thrown away.
  template <typename Work>
  void run(const Work& work) {
    core::Context context{threads_, progress_, {}};
    context.progress.begin();
    status_ = core::guarded([&] {
      if (threads_ < 0) {
        throw core::Failure(StatusCode::InvalidParameter,
                            "setNumberOfThreads: the number must not be negative; 0 = all");
      }
      work(context);
      context.progress.advance(1.0);
      context.checkCancelled();
    });
    status_.warnings = std::move(context.warnings);
  }

  /// What setIndices was given, or null if all points take part.
  const pcl::Indices* chosenIndices() const {
    return this->use_indices_ && !this->fake_indices_ ? this->indices_.get() : nullptr;
  }

  /// The distinct finite points of the input; throws core::Failure.
  core::PointSet preparePoints(core::StoredAs stored_as, core::Context& context) const {
    context.progress.enterStage("prepare", 0.02);
    return pointSetOf<PointType>(this->input_, chosenIndices(), stored_as, context);
  }

 private:
  Status status_;
  Progress progress_;
  int threads_ = 0;
};

/// A step over a PCL base that has no setSearchMethod of its own.
template <typename Base>
class SearchingStep : public Step<Base> {
 public:
  using typename Step<Base>::SearchPtr;

  /// A search of the user's instead of the built-in k-d tree (null = built-in, default); see PclSearch.
  void setSearchMethod(const SearchPtr& search) { search_ = search; }
  SearchPtr getSearchMethod() const { return search_; }

 protected:
  using typename Step<Base>::PointType;

  std::unique_ptr<core::NeighborSearch> prepareSearch(const core::PointSet& points,
                                                      core::Context& context) const {
    context.progress.enterStage("search", 0.1);
    return makeSearch<PointType>(points, search_, context);
  }

 private:
  SearchPtr search_;
};

}  // namespace mlsmesh::detail
