// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace mlsmesh::fuzz {

/// The bytes of one trial as a file of that extension, the same one in every trial of a process. TMPDIR says
/// where; a folder in memory is fast.
inline std::filesystem::path inputFile(const std::uint8_t* data, std::size_t size,
                                       const std::string& extension) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("input-" + std::to_string(getpid()) + "." + extension);
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return file;
}

}  // namespace mlsmesh::fuzz
