#include "server/process/option_text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"
#include "server/http/client_address.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

constexpr std::string_view kSizeLetters = "kmgtp";
constexpr std::array<std::pair<std::string_view, std::uint64_t>, 5> kTimeUnits{
    {{"", 1}, {"s", 1}, {"m", 60}, {"h", 3'600}, {"d", 86'400}}};

/// Of "", "b", "k", "kb" or "kib" and so on, in lower case.
std::optional<std::uint64_t> sizeFactor(std::string_view unit) {
  if (unit.empty() || unit == "b") return 1;
  const std::size_t letter = kSizeLetters.find(unit.front());
  const std::string_view rest = unit.substr(1);
  if (letter == std::string_view::npos || !(rest.empty() || rest == "b" || rest == "i" || rest == "ib")) return {};
  return std::uint64_t{1} << (10 * (letter + 1));
}

std::optional<std::uint64_t> factorOf(std::string_view name, std::string_view unit) {
  if (name == kBytes) return sizeFactor(unit);
  if (name != kSeconds) return unit.empty() ? std::optional<std::uint64_t>(1) : std::nullopt;
  const auto found =
      std::find_if(kTimeUnits.begin(), kTimeUnits.end(), [&](const auto& each) { return each.first == unit; });
  return found == kTimeUnits.end() ? std::nullopt : std::optional(found->second);
}

std::string sizeText(std::uint64_t bytes) {
  std::size_t unit = 0;
  for (; bytes > 0 && bytes % 1024 == 0 && unit < kSizeLetters.size(); ++unit) bytes /= 1024;
  if (unit == 0) return std::to_string(bytes);
  return std::to_string(bytes) + static_cast<char>(kSizeLetters[unit - 1] - 'a' + 'A') + "B";
}

std::string_view unitsOf(std::string_view name) {
  if (name == kBytes) return ", with units KB, MB, GB, TB and PB";
  return name == kSeconds ? ", with units s, m, h and d" : "";
}

bool consistsOf(std::string_view text, std::string_view marks) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           marks.find(c) != std::string_view::npos;
  });
}

} // namespace

std::string toPlainNumber(std::string& text, const OptionValue& value) {
  const std::string_view whole = trimmed(text);
  const std::size_t digits = std::min(whole.find_first_not_of("0123456789"), whole.size());
  const auto number = numberIn<std::uint64_t>(whole.substr(0, digits));
  const auto factor = factorOf(value.name, lowerCase(trimmed(whole.substr(digits))));
  const auto least = static_cast<std::uint64_t>(value.range.min), most = static_cast<std::uint64_t>(value.range.max);
  if (!number || !factor || *number > most / *factor || *number * *factor < least) {
    return (text.empty() ? "An empty text" : asciiExcerpt(text)) + " is not within " + rangeText(value) +
           std::string(unitsOf(value.name)) + ".";
  }
  text = std::to_string(*number * *factor);
  return {};
}

std::string rangeText(const OptionValue& value) {
  const auto shown = [&](double bound) {
    const auto number = static_cast<std::uint64_t>(bound);
    return value.name == kBytes ? sizeText(number) : std::to_string(number);
  };
  return shown(value.range.min) + ".." + shown(value.range.max);
}

std::string listenAddressFault(std::string_view text) {
  const bool isIpv6 = ipAddress(text.substr(0, text.find('%'))).has_value(); // "fe80::1%eth0"
  if (isIpv6 || consistsOf(text, ".-_")) return {};
  return asciiExcerpt(text) + " is neither an address nor the name of a host; a port has an option of its own.";
}

std::string allowedHostFault(std::string_view text) {
  if (text == "*" || consistsOf(text, ".-_:[]")) return {};
  return asciiExcerpt(text) + " is no name that a client can send as Host: render.example, or with a port.";
}

std::string allowedOriginFault(std::string_view text) {
  if (text == "*" || text == "null") return {};
  const std::string scheme = schemeOf(text);
  const std::string_view host = text.substr(std::min(text.size(), scheme.size() + 3));
  const std::string_view usualPort = scheme == "https" ? ":443" : scheme == "http" ? ":80" : "/";
  const bool isOrigin = !scheme.empty() && text.substr(scheme.size()).starts_with("://") && consistsOf(host, ".-_:[]");
  if (isOrigin && !host.ends_with(usualPort)) return {};
  return asciiExcerpt(text) +
         " is no origin as browsers send it: https://page.example, without a path and without the usual port.";
}

} // namespace gnomon
