#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Addresses signed with a key, for requests that can't send one: the pictures of a page.
namespace gnomon {

/// The query keys that signing adds, in this order, at the end.
inline constexpr std::string_view kExpiresKey = "expires";
inline constexpr std::string_view kNameKey = "key";
inline constexpr std::string_view kSignatureKey = "signature";

/// A request target that claims to be signed. Nothing of it is proved.
struct SignedTarget {
  std::string text;      ///< what is signed: the target up to the signature, escapes as they were sent
  std::int64_t expires;  ///< seconds since 1970 in UTC, from which on it is no longer valid
  std::string key;       ///< the name of the key that signed it
  std::string signature; ///< HMAC-SHA256 of `text` under a signing secret of the key, 64 hexadecimal digits
};

/// "/path?query" with "&expires=…&key=…&signature=…" behind it. REQUIRES: a path, no fragment.
std::string signedTarget(std::string_view target, std::int64_t expires, std::string_view key, std::string_view secret);

/// Takes the end of a target apart; nothing where it is not as signedTarget() makes it.
std::optional<SignedTarget> readSignedTarget(std::string_view target);

/// Whether the signature is that of this secret. Takes as long for every signature.
bool isSignedBy(const SignedTarget& target, std::string_view secret);

} // namespace gnomon
