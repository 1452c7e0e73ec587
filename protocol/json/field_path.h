#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

/// A step into JSON: the name of an object's member, or the index of a list's element.
using FieldStep = std::variant<std::string, std::size_t>;

/// The steps of a field's path as FIELDS.md shows it, each list's element with its index in brackets:
/// "lights[0].sun.azimuthDegrees". A part that is a number by itself is an index, too: "lights.0.sun". At least one
/// step. Problems: brackets that hold no index of up to 9 digits, or follow no name.
Result<std::vector<FieldStep>> fieldSteps(std::string_view path);

/// The JSON pointer of such a place: "/lights/0/sun/azimuthDegrees".
std::string pointerOf(const std::vector<FieldStep>& steps);

/// The path of a JSON pointer: "/lights/0/type" gives "lights[0].type".
std::string fieldPath(std::string_view pointer);

} // namespace gnomon
