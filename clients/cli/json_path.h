#pragma once

#include <string>
#include <string_view>

#include "protocol/json_codec.h"

namespace gnomon::cli {

/// "camera.orbit.azimuthDegrees" -> "/camera/orbit/azimuthDegrees".
std::string pointerOf(std::string_view dottedPath);

/// Puts `value` at a dotted path, making the objects on the way; a number steps into a list, where the next free
/// place may be named too. Problems carry the pointer of the step that can't be taken.
Status setAtPath(Json& root, std::string_view dottedPath, Json value);

/// JSON when it is JSON, else a bare word: 3, true, [1,2,3], Large.
Json valueOf(std::string_view text);

} // namespace gnomon::cli
