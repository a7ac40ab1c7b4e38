// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app_error.h"

#include <boost/program_options.hpp>

#include <string>

namespace mlsmesh::apps {

/// An error of an option or argument, "CULPRIT: what is wrong; remedy", with kExitUsage.
AppError usageError(const std::string& culprit, const std::string& what_and_remedy);

/// Parses --name value, --name=value and, as in PCL's tools, -name value; names are not abbreviated.
/// Options with an implicit value, which must be texts, take another only as --name=value.
/// `positions` says what the arguments without a name are called; they are found in the result under that
/// name. Throws AppError (kExitUsage).
boost::program_options::variables_map parseCommandLine(
    int argc, const char* const* argv, const boost::program_options::options_description& options,
    const boost::program_options::positional_options_description& positions);

/// `text` as a finite number, in the C locale. Throws AppError (kExitUsage) that names `culprit`.
double numberFromText(const std::string& culprit, const std::string& text);

}  // namespace mlsmesh::apps
