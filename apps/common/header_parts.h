// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app_error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

// What the checks of PCD's and PLY's headers share.

constexpr std::uintmax_t kLongestHeader = 1 << 18;

AppError wrongType(const std::filesystem::path& file, const std::string& format);
AppError badHeader(const std::filesystem::path& file, const std::string& what);

/// Throws AppError if fewer bytes are there than `items` items of at least `bytes_each` need.
void checkSize(const std::filesystem::path& file, std::uintmax_t available, const std::string& what,
               std::uintmax_t items, std::uintmax_t bytes_each);

/// Throws AppError unless there are `rows` lines of `columns` numbers behind `rows_before` others: the
/// readers take what is not a number for 0 or NaN, and missing numbers for 0.
void checkRows(const std::filesystem::path& file, std::uintmax_t data_offset, std::uintmax_t rows_before,
               std::uintmax_t rows, std::uintmax_t columns);

std::vector<std::string> words(const std::string& line);

/// False if the text is not digits alone, or too many.
bool readCount(const std::string& text, std::uintmax_t& value);

}  // namespace mlsmesh::apps
