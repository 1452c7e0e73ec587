#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/json/json_codec.h"

namespace gnomon {

/// Holds `value` against a JSON Schema (2020-12) of `document`, to which "$ref" refers. Gives the pointer of the first
/// thing that does not fit; "ok" where everything does. A keyword that this does not know fails the check, too.
std::string checkAgainstSchema(const Json& value, const Json& schema, const Json& document, const std::string& at = "");

} // namespace gnomon
