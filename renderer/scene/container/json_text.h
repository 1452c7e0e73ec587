#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"

namespace gnomon {

/// Parses JSON whose root is an object; of a key that comes twice the last counts. Nesting and the number of values are
/// counted on the bytes first, so that no parser meets a text that would exhaust its stack or the memory.
Result<nlohmann::json> parseJsonText(std::string_view text, const Limits& limits);

} // namespace gnomon
