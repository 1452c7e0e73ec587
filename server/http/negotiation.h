#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/spec/traits.h"
#include "server/http/request.h"
#include "server/wire/frame_form.h"

namespace gnomon {

/// The index of the media type that an Accept header prefers among `offers`: of equals the first, which is also the
/// choice without such a header. Nothing: it accepts none of them.
std::optional<std::size_t> preferred(std::optional<std::string_view> accept, std::span<const std::string_view> offers);

/// The refusal of an Accept that lists none of `offers`. `what`: is asked for, as "A frame".
Problem notAcceptable(std::string_view what, std::optional<std::string_view> accept,
                      std::span<const std::string_view> offers);

/// The media types that negotiate() chooses from.
inline constexpr auto kFrameTypes = [] {
  std::array<std::string_view, kFormatTraits.size() + 2> types;
  for (std::size_t i = 0; i < kFormatTraits.size(); ++i) types[i] = kFormatTraits[i].mediaType;
  types[kFormatTraits.size()] = "multipart/mixed";
  types[kFormatTraits.size() + 1] = "application/json";
  return types;
}();

/// The form that Accept (RFC 9110, q-values included) prefers. A format's type in Accept overrides the spec's format;
/// where Accept leaves it open (no Accept, */*, image/*, or a tie) the spec's format is used, and also where Accept
/// takes that but prefers PNG, JPEG or WebP: browsers list these for every picture. Nothing: no form is acceptable.
std::optional<FrameForm> negotiate(std::optional<std::string_view> accept, ImageFormat specFormat);

/// What a request's preconditions say of a representation that there is (RFC 9110 section 13).
enum class Precondition {
  holds,
  known,  ///< If-None-Match names its tag: 304
  exists, ///< If-None-Match is "*": 304 as well
  failed  ///< If-Match names others: 412
};

/// If-Match first, by strong comparison, then If-None-Match, by weak comparison. `etag`: empty = it has none.
Precondition preconditionOf(const Headers& headers, std::string_view etag);

/// The refusal where that failed.
Problem preconditionFailed(const Headers& headers, std::string_view etag);

} // namespace gnomon
