#pragma once

#include <string>
#include <string_view>

#include "protocol/json/json_codec.h"

namespace gnomon::cli {

/// "camera.orbit.azimuthDegrees" -> "/camera/orbit/azimuthDegrees".
std::string pointerOf(std::string_view dottedPath);

/// Puts `value` at a dotted path, making the objects on the way; a number steps into a list, where the next free
/// place may be named too. Problems carry the pointer of the step that can't be taken.
Status setAtPath(Json& root, std::string_view dottedPath, Json value);

/// As in a query string: JSON where the text begins like JSON or is one of its words, else a bare word: 3, true,
/// [1,2,3], Large. JSON that is broken, too deep or has a key twice is a problem.
Result<Json> valueOf(std::string_view text);

} // namespace gnomon::cli
