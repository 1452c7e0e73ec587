#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Text taken apart, and untrusted text made fit for a reply.
namespace gnomon {

/// True where `text` is well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates, at most U+10FFFF).
bool isUtf8(std::string_view text);

/// `text` with each byte that is not part of well-formed UTF-8 replaced by '?'.
std::string asUtf8(std::string_view text);

/// The beginning of well-formed UTF-8 `text`, at most `maxBytes` long, ending between two characters.
std::string_view beginningOf(std::string_view text, std::size_t maxBytes);

/// The same, with an ellipsis, within `maxBytes`, where something was left off.
std::string shortened(std::string_view text, std::size_t maxBytes);

/// Bytes of unknown encoding, to be quoted in a problem: at most 64 of them and then "...", '?' for all but printable
/// ASCII.
std::string asciiExcerpt(std::string_view text);

std::string lowerCase(std::string_view text);    ///< ASCII letters only
std::string_view trimmed(std::string_view text); ///< without spaces and tabs at the ends

/// The parts of `text` between separators: at least one; empty ones are kept.
std::vector<std::string> split(std::string_view text, char separator);

/// The same, each part trimmed; an empty text gives none.
std::vector<std::string> splitTrimmed(std::string_view text, char separator);

/// Three significant digits of a number: "7.07", "0.00012", "1.23e+05".
std::string shortNumber(double value);

/// What may be chosen, for a problem: "one of a, b and 3 more", with at most 20 names. REQUIRES: a name.
std::string oneOf(std::span<const std::string_view> names);

/// Of these names the one that a mistyped one resembles most, by edit distance, where swapped neighbours are one edit;
/// empty where none is near: more than a third of its letters, or more than `most` of them, would have to change.
std::string nearestName(std::string_view mistyped, std::span<const std::string> names,
                        std::size_t most = std::string_view::npos);

/// The end of a sentence that says that there is none of this name: "; did you mean width?", or "." where none is near.
std::string suggestion(std::string_view mistyped, std::span<const std::string> names);

} // namespace gnomon
