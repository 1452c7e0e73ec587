#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace gnomon {

/// Of these names the one that a mistyped one resembles most, by edit distance, where swapped neighbours are one edit;
/// empty where none is near: more than a third of its letters, or more than `most` of them, would have to change.
std::string nearestName(std::string_view mistyped, std::span<const std::string> names,
                        std::size_t most = std::string_view::npos);

/// The end of a sentence that says that there is none of this name: "; did you mean width?", or "." where none is near.
std::string suggestion(std::string_view mistyped, std::span<const std::string> names);

} // namespace gnomon
