#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"

/// Who may do what: the keys that an operator gives to clients, and the addresses that are signed with them.
namespace gnomon {

/// What a request asks for, and what a key allows: flags that are put together with `|`.
enum class Scope : unsigned {
  none = 0,
  read = 1,   ///< look at scenes and capabilities
  render = 2, ///< frames, plans, evaluations, bakes
  upload = 4, ///< store and remove scenes
  admin = 8   ///< everything
};

constexpr Scope operator|(Scope a, Scope b) {
  return static_cast<Scope>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// Whether `granted` allows all of `needed`.
constexpr bool allows(Scope granted, Scope needed) {
  const auto given = static_cast<unsigned>(granted);
  const auto asked = static_cast<unsigned>(needed);
  return (given & static_cast<unsigned>(Scope::admin)) != 0 || (given & asked) == asked;
}

/// The names of a scope's flags, as in a key file: "read,render".
std::string scopeText(Scope scope);

/// One client, as the operator knows it.
struct AccessKey {
  std::string name;                        ///< 1 to 64 of a-z, A-Z, 0-9, '.', '_' and '-'
  std::vector<std::string> secretHashes;   ///< SHA-256 of each secret that proves to be this client, 64 hex digits
  std::vector<std::string> signingSecrets; ///< each makes and checks signed addresses; several while one is replaced
  Scope scope = Scope::none;
  double requestsPerSecond = 0; ///< on average; 0 = without a bound
  double burst = 0;             ///< >= 1 where requestsPerSecond is set: requests that may come at once
  std::size_t concurrent = 0;   ///< requests in progress at once; 0 = without a bound
};

/// Reads a key file: one key a line as FIELD=VALUE pairs with spaces between, empty lines, and comments after '#'.
/// Fields: name, sha256 and signingSecret (each may be repeated), scopes (with commas between), requestsPerSecond,
/// burst (default: a second's worth, at least 1), concurrent. All problems at once, each with its line; none of them
/// quotes a value that may be a secret. A file without a key is one, too.
Result<std::vector<AccessKey>> parseKeyFile(std::string_view text);

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
