#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct evp_md_ctx_st;

/// Bytes, the plain text that they are written as, and their digest.
namespace gnomon {

using Bytes = std::vector<std::uint8_t>;

/// The same bytes, seen as characters. Valid as long as `bytes` are.
inline std::string_view asText(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The same bytes, seen as numbers. Valid as long as `text` is.
inline std::span<const std::uint8_t> asBytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// The unsigned number that `bytes` are, least significant first. REQUIRES: at most 8 bytes.
constexpr std::uint64_t littleEndian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

/// Two lower-case hexadecimal digits for each byte.
std::string hexText(std::span<const std::uint8_t> bytes);

/// Base64 of RFC 4648, section 4, padded, without line breaks.
std::string base64Text(std::span<const std::uint8_t> bytes);

enum class Base64Padding { required, optional };

/// The bytes of a base64 text; nothing if a character or the length is wrong.
std::optional<Bytes> base64Bytes(std::string_view text, Base64Padding padding = Base64Padding::required);

/// `text` with its percent escapes decoded (RFC 3986, section 2.1); nothing if an escape is broken.
std::optional<std::string> percentDecoded(std::string_view text);

/// The scheme of a URI (RFC 3986, section 3.1) in lower case; empty for a relative reference.
std::string schemeOf(std::string_view uri);

/// Whether two texts are the same, in a time that reveals only whether their lengths are equal: for secrets.
bool equalInConstantTime(std::string_view a, std::string_view b);

/// HMAC-SHA256 (RFC 2104) of a text under a secret key: 64 lower-case digits.
std::string hmacSha256Hex(std::string_view key, std::string_view text);

/// SHA-256 over bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  void add(std::span<const std::uint8_t> bytes);
  void add(std::string_view text);
  Bytes bytes();     ///< 32 of them; once, as the last call
  std::string hex(); ///< 64 lower-case digits; once, as the last call

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

} // namespace gnomon
