#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/base/text.h"
#include "protocol/fields/fields.h"
#include "protocol/fields/spellings.h"
#include "protocol/json/json_codec.h"

/// Described structs to JSON: keys in the rows' order, absent fields left out.
namespace gnomon {

inline Json encodeValue(bool value) {
  return value;
}
inline Json encodeValue(int value) {
  return value;
}
inline Json encodeValue(std::int64_t value) {
  return value;
}
inline Json encodeValue(std::uint64_t value) {
  return value;
}
inline Json encodeValue(double value) {
  return value;
}
inline Json encodeValue(const std::string& value) {
  return asUtf8(value);
}

template <Spelled Enum>
Json encodeValue(Enum value) {
  return std::string(spell(value));
}

template <Described T>
Json encodeValue(const T& value);

template <class... Kinds>
Json encodeValue(const std::variant<Kinds...>& value) {
  return std::visit([](const auto& held) { return encodeValue(held); }, value);
}

template <class T, std::size_t kSize>
Json encodeValue(const std::array<T, kSize>& value) {
  Json array = Json::array();
  for (const T& element : value) array.push_back(encodeValue(element));
  return array;
}

template <class T>
Json encodeValue(const std::vector<T>& value) {
  Json array = Json::array();
  for (const T& element : value) array.push_back(encodeValue(element));
  return array;
}

/// A frame's stage times are one object, so that a client can name the stage that it wants.
inline Json encodeValue(const std::vector<StageTime>& stages) {
  Json object = Json::object();
  for (const StageTime& stage : stages) object[stage.stage] = stage.milliseconds;
  return object;
}

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <Described T>
Json encodeValue(const T& value) {
  Json object = Json::object();
  forEachField<T>([&]<class F>(const F& field) {
    const auto& member = value.*field.member;
    if constexpr (kIsOptional<typename F::Member>) {
      if (!member) return;
      if (field.inlined) {
        object.update(encodeValue(*member));
      } else {
        object[std::string(field.name)] = encodeValue(*member);
      }
    } else {
      object[std::string(field.name)] = encodeValue(member);
    }
  });
  return object;
}

} // namespace gnomon
