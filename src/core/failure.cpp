// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/failure.h"

#include <new>

namespace mlsmesh::core {

namespace {

Status failed(StatusCode code, const std::string& message) {
  return {code, message, {}};
}

Status outOfMemory() {
  return failed(StatusCode::OutOfMemory,
                "not enough memory for this cloud; use fewer points or fewer levels");
}

}  // namespace

Status guarded(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const Failure& failure) {
    return failed(failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return outOfMemory();
  } catch (const std::length_error&) {
    return outOfMemory();
  } catch (const std::exception& fault) {
    return failed(StatusCode::Internal, std::string("internal fault, please report it: ") + fault.what());
  } catch (...) {
    return failed(StatusCode::Internal, "internal fault, please report it: an unknown exception");
  }
}

}  // namespace mlsmesh::core
