#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"

namespace gnomon {

/// Parses JSON whose root is an object; of a repeated key the last counts. Nesting and number of values are checked on
/// the bytes first.
Result<nlohmann::json> parseJsonText(std::string_view text, const Limits& limits);

} // namespace gnomon
