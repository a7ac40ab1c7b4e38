// SPDX-License-Identifier: BSD-3-Clause
#include "common/file_bytes.h"

#include "common/app_error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File openToRead(const fs::path& file) {
  File opened(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (opened) return opened;
  const int code = errno;
  if (code == EACCES) throw fileError(file.string(), "may not be read; check its permissions");
  throw fileError(file.string(),
                  "cannot be opened (" + std::generic_category().message(code) + "); check the name");
}

}  // namespace

std::uintmax_t checkReadable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    throw fileError(file.string(), "no such file; check the name");
  }
  if (fs::is_directory(status)) throw fileError(file.string(), "is a folder; give the name of a file");
  openToRead(file);
  if (!fs::is_regular_file(status)) {
    throw fileError(file.string(), "is not a regular file; save the data to a file first");
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw fileError(file.string(), "cannot be read (" + error.message() + "); check the file");
  if (size == 0) throw fileError(file.string(), "is empty (0 bytes); write it again or give another file");
  return size;
}

std::string readBytes(const fs::path& file, std::uintmax_t most) {
  const std::uintmax_t size = std::min(checkReadable(file), most);
  const File opened = openToRead(file);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), opened.get());
  if (got != bytes.size()) {
    throw fileError(file.string(),
                    "could be read only up to byte " + std::to_string(got) + "; check the disk");
  }
  return bytes;
}

std::string extensionOf(const fs::path& file) {
  std::string extension = file.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace mlsmesh::apps
