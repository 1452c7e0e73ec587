#pragma once

#include <string>

#include "protocol/report/replies.h"

namespace gnomon::cli {

/// The summary as a tree of lines for people. `title` is its root.
std::string summaryText(const std::string& title, const SceneSummary& summary);

} // namespace gnomon::cli
