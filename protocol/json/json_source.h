#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

using Json = nlohmann::ordered_json;

struct JsonNode;
struct JsonMember;

/// A number that is not a 64-bit integer, with its own text.
struct JsonReal {
  double value = 0; ///< finite
  std::string text;
};

/// JSON as it was written: members keep their order, also where a key comes twice.
struct JsonNode {
  using Array = std::vector<JsonNode>;
  using Object = std::vector<JsonMember>;
  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, JsonReal, std::string, Array, Object> value;
};

struct JsonMember {
  std::string key;
  JsonNode value;
};

/// Reads untrusted JSON (RFC 8259). Refuses, before anything is parsed, text over kLimits.maxSpecBytes and nesting over
/// kLimits.maxJsonDepth. Adds a problem for each key that comes twice. Nothing = not JSON; the problem says where.
std::optional<JsonNode> readJson(std::string_view text, ProblemList& problems);

/// The same value; of a key that comes twice the last.
Json jsonOf(const JsonNode& node);
JsonNode nodeOf(const Json& json);

/// What a node is, for people: "the number 3.7", shortened.
std::string shownNode(const JsonNode& node);

} // namespace gnomon
