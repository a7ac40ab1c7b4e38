// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mlsmesh::apps {

/// The style sheet and the script of the page, without their tags.
std::string pageStyle();
std::string pageScript();

}  // namespace mlsmesh::apps
