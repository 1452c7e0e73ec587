#pragma once

#include <cstddef>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace gnomon {

/// A member of a material, light or camera that KHR_animation_pointer moves: a number, or an array of numbers.
struct PropertyTarget {
  std::string pointer;                                   ///< into the file's JSON (RFC 6901)
  bool isArray = false;                                  ///< of `components` numbers
  std::size_t components = 1;                            ///< 1 to 4
  double min = -std::numeric_limits<double>::infinity(); ///< what glTF allows of each number
  double max = std::numeric_limits<double>::infinity();
  bool minExcluded = false;
};

/// What a pointer names; nothing where it names no number that is drawn by. An object that the file does not have can't
/// be pointed into, but for a material's pbrMetallicRoughness, which has a default for each member. The document has
/// passed the schema check.
std::optional<PropertyTarget> propertyAt(const nlohmann::json& document, const std::string& pointer);

} // namespace gnomon
