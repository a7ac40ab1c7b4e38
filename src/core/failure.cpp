// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/failure.h"

#include <exception>
#include <new>

namespace mlsmesh::core {

namespace {

Status failed(StatusCode code, const char* before, const char* message) noexcept {
  Status status;
  status.code = code;
  try {
    status.message = before;
    status.message += message;
  } catch (const std::bad_alloc&) {
    status.message = "out of memory";  // fits into the string itself
  }
  return status;
}

Status outOfMemory() noexcept {
  return failed(StatusCode::OutOfMemory, "not enough memory for this cloud; use fewer points or fewer levels",
                "");
}

Status internalFault(const char* what) noexcept {
  return failed(StatusCode::Internal, "internal fault, please report it: ", what);
}

}  // namespace

Status statusOfException() noexcept {
  try {
    throw;
  } catch (const Failure& failure) {
    return failed(failure.code(), failure.what(), "");
  } catch (const std::bad_alloc&) {
    return outOfMemory();
  } catch (const std::length_error&) {
    return outOfMemory();
  } catch (const std::exception& fault) {
    return internalFault(fault.what());
  } catch (...) {
    return internalFault("an unknown exception");
  }
}

}  // namespace mlsmesh::core
