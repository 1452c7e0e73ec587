#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/document/gltf_model.h"

/// What the readers of the file's JSON ask of it. It has passed the schema check.
namespace gnomon {

/// nullptr = the object has no such member.
inline const nlohmann::json* memberOf(const nlohmann::json& object, std::string_view key) {
  const auto member = object.find(key);
  return member == object.end() ? nullptr : &*member;
}

/// nullptr = the object has no such extension.
inline const nlohmann::json* extensionOf(const nlohmann::json& object, std::string_view name) {
  const nlohmann::json* extensions = memberOf(object, "extensions");
  return extensions == nullptr ? nullptr : memberOf(*extensions, name);
}

/// Why the schema check leaves out a part of the file; empty = it is sound, and an object.
inline std::string faultOf(const nlohmann::json& part) {
  return part.is_array() ? part[0].get<std::string>() : std::string();
}

/// Its name; empty where it has none.
inline std::string nameAt(const nlohmann::json& object) {
  return object.is_array() ? object[1].get<std::string>() : object.value("name", std::string());
}

/// A member as a value; nothing where there is none.
template <class T>
std::optional<T> optionalAt(const nlohmann::json& object, std::string_view key) {
  const nlohmann::json* member = memberOf(object, key);
  return member == nullptr ? std::nullopt : std::optional<T>(member->get<T>());
}

/// The enumerator whose name, of these in their order, a member is; `missing` where there is none.
template <class Enum, std::size_t kCount>
Enum namedAt(const nlohmann::json& object, std::string_view key, const std::array<std::string_view, kCount>& names,
             Enum missing) {
  const nlohmann::json* member = memberOf(object, key);
  if (member == nullptr) return missing;
  return static_cast<Enum>(std::ranges::find(names, member->get_ref<const std::string&>()) - names.begin());
}

/// The numbers of a member; nothing where there is none.
template <int kSize>
std::optional<glm::vec<kSize, double>> vectorAt(const nlohmann::json& object, std::string_view key) {
  const nlohmann::json* member = memberOf(object, key);
  if (member == nullptr) return std::nullopt;
  glm::vec<kSize, double> vector(0);
  for (int i = 0; i < kSize; ++i) vector[i] = (*member)[static_cast<std::size_t>(i)].template get<double>();
  return vector;
}

/// What `read` makes of each element of an array; empty where there is none.
template <class Read>
auto listAt(const nlohmann::json& object, std::string_view key, Read read) {
  std::vector<decltype(read(object))> list;
  if (const nlohmann::json* array = memberOf(object, key)) {
    list.reserve(array->size());
    for (const nlohmann::json& each : *array) list.push_back(read(each));
  }
  return list;
}

// From JSON that has passed checkSchema().

/// The typed values of a document; the URIs, which may hold whole files, are moved out of it.
gltf::Model readModel(nlohmann::json document);

gltf::TextureInfo readTextureInfo(const nlohmann::json& source);
gltf::Material readMaterial(const nlohmann::json& source);
gltf::Texture readTexture(const nlohmann::json& source);
gltf::TextureSampler readTextureSampler(const nlohmann::json& source);

} // namespace gnomon
