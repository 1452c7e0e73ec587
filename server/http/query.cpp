#include "server/http/query.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

#include "protocol/base/text.h"

namespace gnomon {

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
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || text.front() == '-') return std::nullopt;
  return number;
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
