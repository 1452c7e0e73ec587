#include "protocol/base/json.h"

#include <charconv>
#include <optional>

#include "protocol/base/text.h"

namespace gnomon {

std::string escapedToken(std::string_view key) {
  std::string token;
  token.reserve(key.size());
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

std::string pointerSegment(std::string_view key) {
  constexpr std::size_t kMaxKeyBytes = 100;
  return "/" + escapedToken(shortened(key, kMaxKeyBytes));
}

std::string Place::pointer() const {
  if (!parent_) return "";
  return parent_->pointer() + (isIndex_ ? "/" + std::to_string(index_) : pointerSegment(key_));
}

bool pointsInto(std::string_view inner, std::string_view outer) {
  return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
}

std::optional<JsonExcess> findExcess(std::string_view text, const JsonShape& bounds) {
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
      if (++depth > bounds.maxDepth) return JsonExcess{JsonExcess::Of::depth, i};
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
    if (values > bounds.maxValues) return JsonExcess{JsonExcess::Of::values, i};
  }
  return std::nullopt;
}

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
  return invalidValue("",
                      "An element of a list has its index, from 0, in brackets behind the list's "
                      "name.",
                      "as lights[0].type", shortened(asUtf8(path), 60));
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
