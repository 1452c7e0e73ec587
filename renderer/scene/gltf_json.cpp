#include "renderer/scene/gltf_json.h"

#include <charconv>

namespace gnomon {

using nlohmann::json;

const json* memberOf(const json& object, std::string_view key) {
  const auto member = object.find(key);
  return member == object.end() ? nullptr : &*member;
}

const json* extensionOf(const json& object, std::string_view name) {
  const json* extensions = memberOf(object, "extensions");
  return extensions == nullptr ? nullptr : memberOf(*extensions, name);
}

std::string nameOf(const json& object) {
  return object.value("name", std::string());
}

std::optional<std::size_t> indexIn(std::string_view token, std::size_t size) {
  std::size_t index = 0;
  const char* end = token.data() + token.size();
  const auto read = std::from_chars(token.data(), end, index);
  const bool isIndex = read.ec == std::errc() && read.ptr == end && (token[0] != '0' || token.size() == 1);
  if (!isIndex || index >= size) return std::nullopt;
  return index;
}

} // namespace gnomon
