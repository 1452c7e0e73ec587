#include "renderer/scene/container/json_text.h"

#include <optional>
#include <string>

namespace gnomon {

namespace {

/// Counts brackets and commas outside strings. Says nothing about whether the text is JSON.
std::optional<Problem> checkShape(std::string_view text, const Limits& limits) {
  int depth = 0;
  std::size_t values = 1;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        inString = false;
      }
      continue;
    }
    if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      ++values;
      if (++depth > limits.maxJsonDepth) {
        return Problem{ProblemCode::tooLarge,
                       {},
                       "The glTF's JSON is nested too deeply.",
                       std::to_string(limits.maxJsonDepth),
                       "more"};
      }
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
    if (values > limits.maxJsonValues) {
      return Problem{ProblemCode::tooLarge,
                     {},
                     "The glTF's JSON holds too many values.",
                     std::to_string(limits.maxJsonValues),
                     "more"};
    }
  }
  return std::nullopt;
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
