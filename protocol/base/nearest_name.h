#pragma once

#include <span>
#include <string>
#include <string_view>

namespace gnomon {

/// Of these names the one that a mistyped one resembles most, by edit distance; empty where none is near: more than a
/// third of its letters would have to change.
std::string nearestName(std::string_view mistyped, std::span<const std::string> names);

} // namespace gnomon
