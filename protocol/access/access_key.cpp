#include "protocol/access/access_key.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"

namespace gnomon {
namespace {

constexpr std::array<std::pair<std::string_view, Scope>, 4> kScopes{
    {{"read", Scope::read}, {"render", Scope::render}, {"upload", Scope::upload}, {"admin", Scope::admin}}};
constexpr double kMostPerSecond = 1e6;
constexpr double kMostAtOnce = 1e6;
constexpr std::size_t kLongestName = 64;
constexpr std::size_t kShortestSigningSecret = 16;
constexpr std::size_t kHashDigits = 64;

bool isName(std::string_view text) {
  return !text.empty() && text.size() <= kLongestName && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '_' ||
           c == '-';
  });
}

bool isHash(std::string_view text) {
  return text.size() == kHashDigits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// The number that `text` is; nothing where it is none, or not within the bounds.
bool readNumber(std::string_view text, double least, double most, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(number) && number >= least &&
         number <= most;
}

/// What is wrong with a value, as the rest of a sentence; empty = nothing, and the key has it.
std::string_view setField(AccessKey& key, std::string_view field, std::string_view value) {
  if (field == "name") {
    key.name = value;
    return isName(value) ? "" : "name takes 1 to 64 letters, digits, '.', '_' and '-'.";
  }
  if (field == "sha256") {
    key.secretHashes.push_back(lowerCase(value));
    return isHash(key.secretHashes.back()) ? "" : "sha256 takes 64 hexadecimal digits.";
  }
  if (field == "signingSecret") {
    key.signingSecrets.emplace_back(value);
    return value.size() >= kShortestSigningSecret ? "" : "signingSecret takes 16 characters or more.";
  }
  if (field == "scopes") {
    for (const std::string& name : splitTrimmed(value, ',')) {
      const auto known =
          std::find_if(kScopes.begin(), kScopes.end(), [&](const auto& scope) { return scope.first == name; });
      if (known == kScopes.end()) return "scopes takes read, render, upload and admin.";
      key.scope = key.scope | known->second;
    }
    return "";
  }
  if (field == "requestsPerSecond") {
    return readNumber(value, 1e-3, kMostPerSecond, key.requestsPerSecond) ? ""
                                                                          : "requestsPerSecond takes 0.001..1000000.";
  }
  if (field == "burst") {
    return readNumber(value, 1, kMostAtOnce, key.burst) ? "" : "burst takes 1..1000000.";
  }
  if (field == "concurrent") {
    double number = 0;
    const bool fits = readNumber(value, 1, kMostAtOnce, number) && number == std::floor(number);
    key.concurrent = fits ? static_cast<std::size_t>(number) : 0;
    return fits ? "" : "concurrent takes a whole number, 1..1000000.";
  }
  return "a field is none of name, sha256, signingSecret, scopes, requestsPerSecond, burst and concurrent.";
}

/// What a key lacks, as the rest of a sentence; empty = nothing.
std::string_view lack(const AccessKey& key) {
  if (key.name.empty()) return "the key has no name.";
  if (key.secretHashes.empty() && key.signingSecrets.empty()) return "the key has neither sha256 nor signingSecret.";
  if (key.scope == Scope::none) return "the key has no scopes.";
  if (key.burst > 0 && key.requestsPerSecond == 0) return "burst means nothing without requestsPerSecond.";
  return "";
}

/// Every FIELD=VALUE of a line; gives what is wrong with them.
std::vector<std::string> readLine(std::string_view line, AccessKey& key) {
  std::vector<std::string> faults;
  std::set<std::string_view> seen;
  while (true) {
    line = trimmed(line);
    if (line.empty()) break;
    const std::string_view pair = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(pair.size());
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const std::string_view field = pair.substr(0, equals);
    const bool mayRepeat = field == "sha256" || field == "signingSecret";
    if (equals == pair.size()) {
      faults.emplace_back("a word is no FIELD=VALUE.");
    } else if (!seen.insert(field).second && !mayRepeat) {
      faults.emplace_back("a field comes twice.");
    } else if (const auto fault = setField(key, field, pair.substr(equals + 1)); !fault.empty()) {
      faults.emplace_back(fault);
    }
  }
  if (faults.empty()) {
    if (const auto missing = lack(key); !missing.empty()) faults.emplace_back(missing);
  }
  return faults;
}

} // namespace

std::string scopeText(Scope scope) {
  std::string text;
  for (const auto& [name, flag] : kScopes) {
    if ((static_cast<unsigned>(scope) & static_cast<unsigned>(flag)) == 0) continue;
    text.append(text.empty() ? "" : ",").append(name);
  }
  return text;
}

Result<std::vector<AccessKey>> parseKeyFile(std::string_view text) {
  std::vector<AccessKey> keys;
  std::set<std::string> names;
  ProblemList problems;
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    AccessKey key;
    std::vector<std::string> faults = readLine(line, key);
    if (faults.empty() && !names.insert(key.name).second) faults.emplace_back("the name is another key's, too.");
    for (const std::string& fault : faults) {
      const std::string place = "line " + std::to_string(number);
      problems.add(invalidValue(place, "The key file, " + place + ": " + fault));
    }
    if (key.requestsPerSecond > 0 && key.burst == 0) key.burst = std::max(1.0, key.requestsPerSecond);
    keys.push_back(std::move(key));
  }
  if (!problems.empty()) return std::move(problems).take();
  if (keys.empty()) return invalidValue("", "The key file has no key.");
  return keys;
}

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
