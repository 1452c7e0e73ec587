#include "server/http/url.h"

#include <algorithm>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

Problem malformedUrl(std::string detail) {
  return {ProblemCode::malformed, "", std::move(detail), "", ""};
}

} // namespace

Result<std::string> decodeUrlText(std::string_view text, bool plusIsSpace) {
  std::string escaped(text);
  if (plusIsSpace) std::replace(escaped.begin(), escaped.end(), '+', ' ');
  std::optional<std::string> decoded = percentDecoded(escaped);
  if (!decoded) return malformedUrl("The address holds a '%' that two hexadecimal digits do not follow.");
  if (std::any_of(decoded->begin(), decoded->end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; })) {
    return malformedUrl("The address holds a control character.");
  }
  return *std::move(decoded);
}

Result<Url> parseTarget(std::string_view target) {
  if (target.empty() || target.front() != '/') return malformedUrl("The request target must begin with '/'.");
  const std::size_t mark = target.find('?');
  std::string_view path = target.substr(1, mark == std::string_view::npos ? mark : mark - 1);
  Url url;
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    auto segment = decodeUrlText(path.substr(0, slash), false);
    if (!segment) return std::move(segment).problems();
    if (*segment == "." || *segment == "..") return malformedUrl("The path must not hold '.' or '..'.");
    url.path.push_back(*std::move(segment));
    if (slash == std::string_view::npos) break;
    path.remove_prefix(slash + 1);
    if (path.empty()) url.path.emplace_back(); // a trailing slash is another path
  }
  if (mark == std::string_view::npos) return url;
  std::string_view query = target.substr(mark + 1);
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view pair = query.substr(0, end);
    query.remove_prefix(end == std::string_view::npos ? query.size() : end + 1);
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    auto key = decodeUrlText(pair.substr(0, equals), true);
    auto value = equals == std::string_view::npos ? Result<std::string>(std::string())
                                                  : decodeUrlText(pair.substr(equals + 1), true);
    if (!key) return std::move(key).problems();
    if (!value) return std::move(value).problems();
    url.query.emplace_back(*std::move(key), *std::move(value));
  }
  return url;
}

} // namespace gnomon
