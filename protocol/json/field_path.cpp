#include "protocol/json/field_path.h"

#include <charconv>
#include <optional>

#include "protocol/base/json.h"
#include "protocol/base/text.h"

namespace gnomon {
namespace {

std::optional<std::size_t> indexOf(std::string_view digits) {
  constexpr std::size_t kMostDigits = 9;
  std::size_t index = 0;
  const char* end = digits.data() + digits.size();
  if (digits.size() > kMostDigits) return std::nullopt;
  const auto [stop, error] = std::from_chars(digits.data(), end, index);
  if (error != std::errc() || stop != end) return std::nullopt;
  return index;
}

Problem wrongBrackets(std::string_view path) {
  return {ProblemCode::invalidValue, "",
          "An element of a list has its index, from 0, in brackets behind the list's "
          "name.",
          "as lights[0].type", shortened(asUtf8(path), 60)};
}

} // namespace

Result<std::vector<FieldStep>> fieldSteps(std::string_view path) {
  std::vector<FieldStep> steps;
  for (const std::string& part : split(path, '.')) {
    const std::size_t name = part.find_first_of("[]");
    if (name == std::string::npos) {
      const auto index = indexOf(part);
      steps.push_back(index ? FieldStep(*index) : FieldStep(part));
      continue;
    }
    if (name == 0) return wrongBrackets(path);
    steps.emplace_back(part.substr(0, name));
    for (std::size_t at = name; at < part.size();) {
      const std::size_t close = part.find(']', at);
      if (part[at] != '[' || close == std::string::npos) return wrongBrackets(path);
      const auto index = indexOf(std::string_view(part).substr(at + 1, close - at - 1));
      if (!index) return wrongBrackets(path);
      steps.emplace_back(*index);
      at = close + 1;
    }
  }
  return steps;
}

std::string pointerOf(const std::vector<FieldStep>& steps) {
  std::string pointer;
  for (const FieldStep& step : steps) {
    const auto* name = std::get_if<std::string>(&step);
    pointer += name ? pointerSegment(*name) : "/" + std::to_string(std::get<std::size_t>(step));
  }
  return pointer;
}

std::string fieldPath(std::string_view pointer) {
  std::string path;
  if (pointer.empty()) return path;
  for (const std::string& part : split(pointer.substr(1), '/')) {
    const bool isIndex = !path.empty() && indexOf(part);
    path += isIndex ? "[" + part + "]" : (path.empty() ? "" : ".") + part;
  }
  return path;
}

} // namespace gnomon
