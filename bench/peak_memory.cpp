// SPDX-License-Identifier: BSD-3-Clause
#include "peak_memory.h"

#include <malloc.h>
#include <sys/resource.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace mlsmesh::bench {
namespace {

// The kernel counts in kibibytes.
std::size_t statusEntry(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kibibytes = 0;
    if (word == name && status >> kibibytes) return kibibytes * 1024;
  }
  throw std::runtime_error("/proc/self/status does not tell " + name);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::size_t residentNow() {
  malloc_trim(0);
  return statusEntry("VmRSS:");
}

bool restartResidentPeak() {
  std::ofstream peak("/proc/self/clear_refs");
  peak << "5" << std::flush;
  return peak.good();
}

std::size_t residentPeak() {
  return statusEntry("VmHWM:");
}

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace mlsmesh::bench
