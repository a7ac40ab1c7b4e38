// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
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

/// Runs `work` and turns what it throws into a status: Failure into its code, std::bad_alloc and
/// std::length_error into OutOfMemory, anything else into Internal.
Status guarded(const std::function<void()>& work);

}  // namespace mlsmesh::core
