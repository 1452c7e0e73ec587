#include "renderer/scene/container/json_text.h"

#include <optional>
#include <string>

#include "protocol/base/json.h"

namespace gnomon {

namespace {

std::optional<Problem> checkShape(std::string_view text, const Limits& limits) {
  const auto excess = findExcess(text, {limits.maxJsonDepth, limits.maxJsonValues});
  if (!excess) return std::nullopt;
  if (excess->of == JsonExcess::Of::depth) {
    return Problem{ProblemCode::tooLarge,
                   {},
                   "The glTF's JSON is nested too deeply.",
                   std::to_string(limits.maxJsonDepth),
                   "more"};
  }
  return Problem{ProblemCode::tooLarge,
                 {},
                 "The glTF's JSON holds too many values.",
                 std::to_string(limits.maxJsonValues),
                 "more"};
}

} // namespace

Result<nlohmann::json> parseJsonText(std::string_view text, const Limits& limits) {
  if (auto problem = checkShape(text, limits)) return *std::move(problem);
  try {
    nlohmann::json document = nlohmann::json::parse(text);
    if (!document.is_object()) {
      return Problem{ProblemCode::malformed, {}, "The glTF's JSON is not an object.", {}, {}};
    }
    return document;
  } catch (const nlohmann::json::parse_error& error) {
    return Problem{ProblemCode::malformed,
                   {},
                   "The glTF is not valid JSON: byte " + std::to_string(error.byte) + " is unexpected.",
                   {},
                   {}};
  } catch (const nlohmann::json::exception&) {
    return Problem{ProblemCode::malformed, {}, "The glTF's JSON holds a number that no double can hold.", {}, {}};
  }
}

} // namespace gnomon
