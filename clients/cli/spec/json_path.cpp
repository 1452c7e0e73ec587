#include "clients/cli/spec/json_path.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "protocol/base/text.h"
#include "protocol/json/json_source.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

std::optional<std::size_t> indexOf(const std::string& step) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error != std::errc() || end != step.data() + step.size()) return std::nullopt;
  return index;
}

/// The place one step below `node`, made where it may be made; null when the step can't be taken.
Json* stepInto(Json& node, const std::string& step) {
  const auto index = indexOf(step);
  if (node.is_null()) node = index ? Json::array() : Json::object();
  if (node.is_object() && !step.empty()) return &node[step];
  if (!node.is_array() || !index || *index > node.size()) return nullptr;
  if (*index == node.size()) node.push_back(nullptr);
  return &node[*index];
}

} // namespace

std::string pointerOf(std::string_view dottedPath) {
  std::string pointer = "/" + std::string(dottedPath);
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  return pointer;
}

Status setAtPath(Json& root, std::string_view dottedPath, Json value) {
  const auto parts = split(dottedPath, '.');
  if (parts.size() > static_cast<std::size_t>(kLimits.maxJsonDepth)) {
    return Problem{ProblemCode::invalidValue, "", "The path is too deep.",
                   std::to_string(kLimits.maxJsonDepth) + " steps", std::to_string(parts.size())};
  }
  Json* place = &root;
  std::string pointer;
  for (const std::string& step : parts) {
    pointer += "/" + step;
    place = stepInto(*place, step);
    if (!place) return Problem{ProblemCode::invalidValue, pointer, "There is no such place in the spec.", "", ""};
  }
  *place = std::move(value);
  return Done{};
}

Result<Json> valueOf(std::string_view text) {
  const bool isWord = text == "true" || text == "false" || text == "null";
  const bool isJson = isWord || (!text.empty() && std::string_view("{[\"-0123456789").find(text[0]) != text.npos);
  if (!isJson) return Json(std::string(text));
  ProblemList problems;
  if (!readJson(text, problems) || !problems.empty()) return std::move(problems).take();
  return Json::parse(text);
}

} // namespace gnomon::cli
