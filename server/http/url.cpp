#include "server/http/url.h"

#include <algorithm>
#include <set>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"
#include "server/system/numbers.h"

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

QueryKeys QueryKeys::any() {
  QueryKeys keys;
  keys.isAny_ = true;
  return keys;
}

Problems QueryKeys::check(const Query& query) const {
  if (isAny_) return {};
  std::string known;
  for (const std::string& name : names_) known += (known.empty() ? "" : ", ") + name;
  ProblemList problems;
  std::set<std::string_view> seen;
  for (const auto& [key, value] : query) {
    const std::string pointer = "/" + asciiExcerpt(key);
    if (std::find(names_.begin(), names_.end(), key) == names_.end()) {
      problems.add({ProblemCode::invalidValue, pointer, "There is no query key of this name.",
                    known.empty() ? "no query" : known, ""});
    } else if (!seen.insert(key).second) {
      problems.add({ProblemCode::invalidValue, pointer, "The query key is repeated.", "", ""});
    }
  }
  return std::move(problems).take();
}

std::optional<std::string_view> queryText(const Query& query, std::string_view key) {
  const auto found = std::find_if(query.begin(), query.end(), [&](const auto& pair) { return pair.first == key; });
  return found == query.end() ? std::nullopt : std::optional<std::string_view>(found->second);
}

Result<bool> queryFlag(const Query& query, std::string_view key) {
  const std::string_view text = queryText(query, key).value_or("false");
  if (text == "true" || text == "false") return text == "true";
  return Problem{ProblemCode::invalidValue, "/" + std::string(key), "The value is neither true nor false.",
                 "true or false", asciiExcerpt(text)};
}

std::optional<int> wholeNumber(std::string_view text) {
  return text.starts_with('-') ? std::nullopt : numberIn<int>(text);
}

Result<std::optional<int>> queryNumber(const Query& query, std::string_view key, int least, int most,
                                       std::string_view wrong) {
  const auto text = queryText(query, key);
  if (!text) return std::optional<int>();
  const auto number = wholeNumber(*text);
  if (!number || *number < least || *number > most) {
    return Problem{ProblemCode::invalidValue, "/" + std::string(key), std::string(wrong),
                   std::to_string(least) + ".." + std::to_string(most), asciiExcerpt(*text)};
  }
  return number;
}

} // namespace gnomon
