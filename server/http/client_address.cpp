#include "server/http/client_address.h"

#include <algorithm>
#include <arpa/inet.h>
#include <netinet/in.h>

#include "protocol/base/text.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

constexpr std::array<std::uint8_t, 12> kMapped{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff}; ///< IPv4 within IPv6

/// "192.0.2.7", "192.0.2.7:80", "2001:db8::1", "[2001:db8::1]" or "[2001:db8::1]:80".
std::optional<IpAddress> hopAddress(std::string_view text) {
  constexpr int kMostPort = 65'535;
  const auto isPort = [](std::string_view rest) {
    return rest.empty() || (rest.front() == ':' && numberIn(rest.substr(1), 0, kMostPort));
  };
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos || !isPort(text.substr(end + 1))) return std::nullopt;
    const auto address = ipAddress(text.substr(1, end - 1));
    return text.substr(1, end - 1).find(':') == std::string_view::npos ? std::nullopt : address;
  }
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || text.find(':', colon + 1) != std::string_view::npos) return ipAddress(text);
  return isPort(text.substr(colon)) ? ipAddress(text.substr(0, colon)) : std::nullopt;
}

/// The parts between separators that stand in no quotes; nothing where quotes do not end.
std::optional<std::vector<std::string_view>> splitUnquoted(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (text[i] == separator && !quoted) {
      parts.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  if (quoted) return std::nullopt;
  parts.push_back(text.substr(begin));
  return parts;
}

/// The value of `for` in one element of Forwarded; empty where there is not exactly one. No address has a character
/// that is escaped within quotes.
std::string_view forOf(std::string_view element) {
  std::string_view found;
  for (const std::string_view pair : splitUnquoted(element, ';').value_or(std::vector<std::string_view>())) {
    const std::string_view parameter = trimmed(pair);
    const std::size_t equals = parameter.find('=');
    if (equals == std::string_view::npos || lowerCase(parameter.substr(0, equals)) != "for") continue;
    if (!found.empty()) return {};
    found = parameter.substr(equals + 1);
  }
  if (found.size() >= 2 && found.front() == '"' && found.back() == '"') return found.substr(1, found.size() - 2);
  return found;
}

/// The hops of a request, the last one at the end.
std::vector<std::string_view> forwardedFor(std::string_view value) {
  std::vector<std::string_view> hops;
  for (const std::string_view element : splitUnquoted(value, ',').value_or(std::vector<std::string_view>())) {
    hops.push_back(forOf(element));
  }
  return hops;
}

bool holdsAny(const std::vector<IpNetwork>& networks, const IpAddress& address) {
  return std::any_of(networks.begin(), networks.end(),
                     [&](const IpNetwork& network) { return network.holds(address); });
}

IpAddress lastUntrusted(IpAddress peer, const std::vector<std::string_view>& hops,
                        const std::vector<IpNetwork>& trusted) {
  for (auto hop = hops.rbegin(); hop != hops.rend() && holdsAny(trusted, peer); ++hop) {
    const auto address = hopAddress(trimmed(*hop));
    if (!address) break;
    peer = *address;
  }
  return peer;
}

std::optional<IpNetwork> ipNetwork(std::string_view text) {
  const std::size_t slash = text.find('/');
  const auto first = ipAddress(text.substr(0, slash));
  if (!first) return std::nullopt;
  const int most = first->isIpv6 ? 128 : 32;
  if (!first->isIpv6 && text.find(':') != std::string_view::npos) return std::nullopt; // its length is that of IPv6
  const auto bits = slash == std::string_view::npos ? std::optional(most) : numberIn(text.substr(slash + 1), 0, most);
  if (!bits) return std::nullopt;
  for (int bit = *bits; bit < most; ++bit) {
    if ((first->bytes[static_cast<std::size_t>(bit / 8)] >> (7 - bit % 8)) & 1) return std::nullopt;
  }
  return IpNetwork{*first, *bits};
}

std::string textOf(const IpAddress& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_ntop(address.isIpv6 ? AF_INET6 : AF_INET, address.bytes.data(), text.data(), text.size());
  return text.data();
}

} // namespace

std::optional<IpAddress> ipAddress(std::string_view text) {
  const std::string whole(text);
  if (whole.size() > INET6_ADDRSTRLEN || whole.find('\0') != std::string::npos) return std::nullopt;
  IpAddress address;
  if (::inet_pton(AF_INET, whole.c_str(), address.bytes.data()) == 1) return address;
  if (::inet_pton(AF_INET6, whole.c_str(), address.bytes.data()) != 1) return std::nullopt;
  address.isIpv6 = !std::equal(kMapped.begin(), kMapped.end(), address.bytes.begin());
  if (!address.isIpv6) {
    std::copy(address.bytes.begin() + kMapped.size(), address.bytes.end(), address.bytes.begin());
    std::fill(address.bytes.begin() + 4, address.bytes.end(), std::uint8_t{0});
  }
  return address;
}

PeerAddress peerAddress(const IpAddress& address) {
  const std::string text = textOf(address);
  if (!address.isIpv6) return {text, {text, text}};
  const auto network = [&](std::size_t bytes) {
    IpAddress first = address;
    std::fill(first.bytes.begin() + static_cast<std::ptrdiff_t>(bytes), first.bytes.end(), std::uint8_t{0});
    return textOf(first) + "/" + std::to_string(8 * bytes);
  };
  return {text, {network(8), network(6)}};
}

bool IpNetwork::holds(const IpAddress& address) const {
  if (address.isIpv6 != first.isIpv6) return false;
  const auto whole = static_cast<std::size_t>(bits / 8);
  if (!std::equal(first.bytes.begin(), first.bytes.begin() + whole, address.bytes.begin())) return false;
  return bits % 8 == 0 || ((first.bytes[whole] ^ address.bytes[whole]) >> (8 - bits % 8)) == 0;
}

Result<std::vector<IpNetwork>> ipNetworks(const std::vector<std::string>& texts) {
  std::vector<IpNetwork> networks;
  Problems problems;
  for (const std::string& text : texts) {
    if (const auto network = ipNetwork(text)) {
      networks.push_back(*network);
    } else {
      problems.push_back({ProblemCode::invalidValue, "", "This is neither an address nor a network.",
                          "192.0.2.7, 10.0.0.0/8, 2001:db8::/32", asciiExcerpt(text)});
    }
  }
  if (!problems.empty()) return problems;
  return networks;
}

PeerAddress clientAddress(const PeerAddress& peer, const Headers& headers, const std::vector<IpNetwork>& trusted) {
  if (trusted.empty()) return peer;
  const auto address = ipAddress(peer.text);
  if (!address || !holdsAny(trusted, *address)) return peer;
  const auto listed = headerValue(headers, "x-forwarded-for");
  const auto described = headerValue(headers, "forwarded");
  const auto byList =
      listed ? lastUntrusted(*address, splitUnquoted(*listed, ',').value_or(std::vector<std::string_view>()), trusted)
             : *address;
  const auto byPairs = described ? lastUntrusted(*address, forwardedFor(*described), trusted) : *address;
  if (listed && described && byList != byPairs) return peer;
  return peerAddress(listed ? byList : byPairs);
}

} // namespace gnomon
