// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "mlsmesh/status.h"

namespace mlsmesh::core {

/// How the core leaves a computation early. Never crosses a verb of the public classes: see guarded().
class Failure : public std::runtime_error {
 public:
  Failure(StatusCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  StatusCode code() const { return code_; }

 private:
  StatusCode code_;
};

/// The exception that is being handled as a status: Failure as its code, std::bad_alloc and std::length_error
/// as OutOfMemory, anything else as Internal. Where there is no memory for the text it is a short one.
Status statusOfException() noexcept;

/// Runs `work` and turns what it throws into a status. Throws nothing, and takes no memory of its own.
template <typename Work>
Status guarded(const Work& work) noexcept {
  try {
    work();
    return {};
  } catch (...) {
    return statusOfException();
  }
}

}  // namespace mlsmesh::core
