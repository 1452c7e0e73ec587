#include "server/redis/address.h"

#include <algorithm>
#include <fstream>

#include "protocol/base/bytes.h"
#include "server/system/numbers.h"

namespace gnomon::redis {
namespace {

constexpr std::string_view kPlain = "redis://";
constexpr std::string_view kEncrypted = "rediss://";

Problem refused(std::string detail, std::string limit = "redis[s]://[[USER]:PASSWORD@]HOST[:PORT][/DATABASE]") {
  return {ProblemCode::invalidValue, "", std::move(detail), std::move(limit), ""};
}

/// What stands before the first `mark`, which goes with it; everything where there is none.
std::string_view takeUntil(std::string_view& text, char mark) {
  const std::string_view taken = text.substr(0, text.find(mark));
  text.remove_prefix(std::min(text.size(), taken.size() + 1));
  return taken;
}

bool isHost(std::string_view text) {
  return !text.empty() && text.size() <= 253 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
           c == '_' || c == ':';
  });
}

/// "user:password", ":password", "password" or "user:".
Status readUser(std::string_view text, Address& address) {
  const bool hasUser = text.find(':') != text.npos;
  const auto user = hasUser ? percentDecoded(takeUntil(text, ':')) : std::optional<std::string>("");
  const auto password = percentDecoded(text);
  if (!user || !password) return refused("A percent escape in the user or password of the Redis address is broken.");
  address.user = *user;
  address.password = *password;
  return Done{};
}

/// "host", "host:port", "[address]" or "[address]:port".
Status readHost(std::string_view text, Address& address) {
  std::string_view port;
  const bool isBracketed = text.starts_with('[');
  if (isBracketed) {
    if (text.find(']') == text.npos) return refused("The host of the Redis address can't be read.");
    text.remove_prefix(1);
    address.host = takeUntil(text, ']');
    if (!text.empty() && !text.starts_with(':')) return refused("The host of the Redis address can't be read.");
    port = text;
    if (!port.empty()) port.remove_prefix(1);
  } else {
    address.host = takeUntil(text, ':');
    port = text;
  }
  const bool hasColon = address.host.find(':') != std::string::npos;
  if (!isHost(address.host) || hasColon != isBracketed) return refused("The Redis address has no valid host.");
  if (port.empty()) return Done{};
  const auto number = numberIn(port, 1, 65'535);
  if (!number) return refused("The port of the Redis address is out of range.", "1..65535");
  address.port = static_cast<std::uint16_t>(*number);
  return Done{};
}

} // namespace

bool isAddress(std::string_view text) {
  return schemeOf(text) == "redis" || schemeOf(text) == "rediss";
}

Result<Address> parseAddress(std::string_view text) {
  Address address;
  address.isEncrypted = schemeOf(text) == "rediss";
  const std::string_view scheme = address.isEncrypted ? kEncrypted : kPlain;
  if (!isAddress(text) || !text.substr(scheme.size() - 3).starts_with("://")) {
    return refused("The Redis address does not begin with redis:// or rediss://.");
  }
  text.remove_prefix(scheme.size());
  std::string_view database = text;
  std::string_view authority = takeUntil(database, '/');
  if (const auto at = authority.rfind('@'); at != authority.npos) {
    if (const Status read = readUser(authority.substr(0, at), address); !read) return read.problems();
    authority.remove_prefix(at + 1);
  }
  if (const Status read = readHost(authority, address); !read) return read.problems();
  if (!database.empty()) {
    const auto number = numberIn(database, 0, 65'535);
    if (!number) return refused("The database of the Redis address is no number of the range.", "0..65535");
    address.database = *number;
  }
  return address;
}

std::string shownText(const Address& address) {
  const bool isNumeric6 = address.host.find(':') != std::string::npos;
  return std::string(address.isEncrypted ? kEncrypted : kPlain) + (isNumeric6 ? "[" : "") + address.host +
         (isNumeric6 ? "]" : "") + ":" + std::to_string(address.port) + "/" + std::to_string(address.database);
}

Result<std::string> passwordFrom(const std::string& file) {
  constexpr std::size_t kMost = 4'096;
  std::ifstream stream(file, std::ios::binary);
  std::string text(kMost + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  text.resize(std::min(text.find_first_of("\r\n"), text.size()));
  if (text.empty() || text.size() > kMost) {
    return Problem{ProblemCode::invalidValue, "", "The file has no password in its first line, or can't be read.",
                   "1..4096 bytes", file};
  }
  return text;
}

} // namespace gnomon::redis
