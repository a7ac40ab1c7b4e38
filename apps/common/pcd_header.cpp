// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "common/file_bytes.h"
#include "common/header_check.h"
#include "common/header_parts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 11> kPcdKeys = {"VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
                                                  "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/// PCL's reader goes on behind DATA for as long as it finds comments and keywords, and crashes over some of
/// them.
void checkBehindHeader(const fs::path& file, std::uintmax_t data_offset) {
  const std::uintmax_t whole = fs::file_size(file);
  for (std::uintmax_t most = 1 << 16;; most *= 16) {
    std::istringstream lines(
        readBytes(file, data_offset + most).substr(static_cast<std::size_t>(data_offset)));
    std::string line;
    while (std::getline(lines, line)) {
      const std::vector<std::string> entry = words(line);
      if (entry.empty() || entry[0][0] == '#') continue;
      for (const char* key : kPcdKeys)
        if (entry[0].rfind(key, 0) == 0) throw badHeader(file, std::string(key) + " behind DATA");
      return;
    }
    if (data_offset + most >= whole) return;
  }
}

/// Keyword -> the words that follow, up to and with DATA; and where the data start.
struct PcdHeader {
  std::map<std::string, std::vector<std::string>> entries;
  std::uintmax_t data_offset = 0;

  bool has(const std::string& key) const { return entries.count(key) != 0 && !entries.at(key).empty(); }
  std::uintmax_t count(const std::string& key, const fs::path& file) const {
    std::uintmax_t value = 0;
    if (!has(key) || !readCount(entries.at(key)[0], value)) throw badHeader(file, "no usable " + key);
    return value;
  }
};

PcdHeader readPcdHeader(const fs::path& file) {
  std::istringstream lines(readBytes(file, kLongestHeader));
  PcdHeader header;
  std::string line;
  while (std::getline(lines, line)) {
    std::vector<std::string> entry = words(line);
    if (entry.empty() || entry[0][0] == '#') continue;
    const std::string key = entry[0] == "COLUMNS" ? "FIELDS" : entry[0];
    if (std::find(kPcdKeys.begin(), kPcdKeys.end(), key) == kPcdKeys.end()) throw wrongType(file, "PCD");
    if (header.entries.count(key) != 0) throw badHeader(file, key + " twice");
    if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
      if (header.entries.count("FIELDS") == 0) throw badHeader(file, key + " before FIELDS");
    }
    header.entries[key].assign(entry.begin() + 1, entry.end());
    if (key != "DATA") continue;
    header.data_offset = lines.eof() ? fs::file_size(file) : static_cast<std::uintmax_t>(lines.tellg());
    return header;
  }
  throw wrongType(file, "PCD");
}

/// Values and bytes of a point.
struct PointSize {
  std::uintmax_t values = 0;
  std::uintmax_t bytes = 0;
};

PointSize pcdPointSize(const PcdHeader& header, const fs::path& file) {
  PointSize point;
  if (!header.has("FIELDS")) throw badHeader(file, "no FIELDS");
  const std::size_t fields = header.entries.at("FIELDS").size();
  for (const char* key : {"SIZE", "TYPE", "COUNT"}) {
    if (!header.has(key) && std::string(key) == "COUNT") continue;
    if (!header.has(key) || header.entries.at(key).size() != fields) {
      throw badHeader(file, std::string(key) + " does not match FIELDS");
    }
  }
  for (std::size_t i = 0; i < fields; ++i) {
    std::uintmax_t size = 0;
    std::uintmax_t count = 1;
    const std::string& type = header.entries.at("TYPE")[i];
    const bool known =
        readCount(header.entries.at("SIZE")[i], size) && (size == 1 || size == 2 || size == 4 || size == 8) &&
        (type == "I" || type == "U" || (type == "F" && size >= 4)) &&
        (!header.has("COUNT") || readCount(header.entries.at("COUNT")[i], count)) && count < 1000000;
    if (!known)
      throw badHeader(file, "type, size or count of field '" + header.entries.at("FIELDS")[i] + "'");
    point.values += count;
    point.bytes += size * count;
  }
  return point;
}

/// The two lengths that precede compressed data.
void checkCompressed(const fs::path& file, const PcdHeader& header, std::uintmax_t points,
                     const PointSize& point) {
  const std::string bytes = readBytes(file, header.data_offset + 8);
  if (bytes.size() < header.data_offset + 8) checkSize(file, 0, "points", points, point.bytes);
  const auto length = [&](std::size_t at) {
    std::uintmax_t value = 0;
    for (std::size_t i = 4; i-- > 0;) {
      value = value << 8 |
              static_cast<unsigned char>(bytes[static_cast<std::size_t>(header.data_offset) + at + i]);
    }
    return value;
  };
  checkSize(file, fs::file_size(file) - header.data_offset - 8, "compressed bytes", length(0), 1);
  // Three bytes stand for at most 264 (LZF).
  if (length(4) / 88 > length(0)) throw badHeader(file, "length of the compressed data");
  if (length(4) != points * point.bytes) throw badHeader(file, "length of the compressed data");
}

}  // namespace

std::uintmax_t checkPcdHeader(const fs::path& file) {
  const PcdHeader header = readPcdHeader(file);
  const PointSize point = pcdPointSize(header, file);
  const std::uintmax_t points = header.count("POINTS", file);
  const std::uintmax_t width = header.count("WIDTH", file);
  const std::uintmax_t height = header.has("HEIGHT") ? header.count("HEIGHT", file) : 1;
  if (width > UINT32_MAX || height > UINT32_MAX || width * height != points) {
    throw badHeader(file, "POINTS is not WIDTH x HEIGHT");
  }
  const std::uintmax_t available = fs::file_size(file) - header.data_offset;
  const std::string& storage = header.has("DATA") ? header.entries.at("DATA")[0] : std::string();
  checkBehindHeader(file, header.data_offset);
  if (points == 0) throw fileError(file.string(), "holds no points (POINTS 0); give a file with points");
  if (storage == "ascii") {
    checkSize(file, available + 1, "points", points, 2 * point.values);
    checkRows(file, header.data_offset, 0, points, point.values);
  } else if (storage == "binary") {
    checkSize(file, available, "points", points, point.bytes);
  } else if (storage == "binary_compressed") {
    checkCompressed(file, header, points, point);
  } else {
    throw badHeader(file, "DATA is neither ascii, binary nor binary_compressed");
  }
  return points * point.bytes;
}

}  // namespace mlsmesh::apps
