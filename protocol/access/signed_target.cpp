#include "protocol/access/signed_target.h"

#include <charconv>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

/// Cuts the last "?NAME=VALUE" or "&NAME=VALUE" off; nothing where the last pair has another name.
std::optional<std::string_view> takeLast(std::string_view& target, std::string_view name) {
  const std::size_t mark = target.find_last_of("?&");
  if (mark == std::string_view::npos) return std::nullopt;
  std::string_view pair = target.substr(mark + 1);
  if (!pair.starts_with(name)) return std::nullopt;
  pair.remove_prefix(name.size());
  if (!pair.starts_with('=')) return std::nullopt;
  target = target.substr(0, mark);
  return pair.substr(1);
}

void append(std::string& target, std::string_view name, std::string_view value) {
  target += target.find('?') == std::string::npos ? '?' : '&';
  target.append(name).append("=").append(value);
}

} // namespace

std::string signedTarget(std::string_view target, std::int64_t expires, std::string_view key, std::string_view secret) {
  std::string text(target);
  append(text, kExpiresKey, std::to_string(expires));
  append(text, kNameKey, key);
  const std::string signature = hmacSha256Hex(secret, text);
  append(text, kSignatureKey, signature);
  return text;
}

std::optional<SignedTarget> readSignedTarget(std::string_view target) {
  const auto signature = takeLast(target, kSignatureKey);
  if (!signature) return std::nullopt;
  const std::string text(target);
  const auto key = takeLast(target, kNameKey);
  if (!key) return std::nullopt;
  const auto expires = takeLast(target, kExpiresKey);
  if (!expires) return std::nullopt;
  std::int64_t seconds = 0;
  const auto [end, error] = std::from_chars(expires->data(), expires->data() + expires->size(), seconds);
  if (error != std::errc() || end != expires->data() + expires->size()) return std::nullopt;
  return SignedTarget{text, seconds, std::string(*key), std::string(*signature)};
}

bool isSignedBy(const SignedTarget& target, std::string_view secret) {
  return equalInConstantTime(hmacSha256Hex(secret, target.text), target.signature);
}

} // namespace gnomon
