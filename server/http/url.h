#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

using Query = std::vector<std::pair<std::string, std::string>>; ///< keys and values, decoded, in order

struct Url {
  std::vector<std::string> path; ///< decoded segments; "/" has none; "." and ".." are refused
  Query query;                   ///< "a" means ("a", "")
};

/// A request target in origin form ("/a/b?c=d"). Decoded text holds no control characters.
Result<Url> parseTarget(std::string_view target);

/// Percent-decoding; with `plusIsSpace` as in a query string. A broken or control-character escape is malformed.
Result<std::string> decodeUrlText(std::string_view text, bool plusIsSpace);

/// The keys that a query may have, each at most once.
class QueryKeys {
 public:
  QueryKeys() = default; ///< none
  QueryKeys(std::initializer_list<std::string_view> names) : names_(names.begin(), names.end()) {}

  /// Of a route that reads its query by itself, or that has no use for one but is asked by programs that add theirs.
  static QueryKeys any();

  /// A problem for each key that is none of these or is repeated. Pointers name the key.
  Problems check(const Query& query) const;

 private:
  std::vector<std::string> names_;
  bool isAny_ = false;
};

/// Digits alone; nothing where the text is no number from 0 to 2^31 - 1.
std::optional<int> wholeNumber(std::string_view text);

/// The whole number under `key`; nothing where the query has no such key. `wrong` says in a sentence what a value that
/// is no number within least..most is not.
Result<std::optional<int>> queryNumber(const Query& query, std::string_view key, int least, int most,
                                       std::string_view wrong);

/// Whether `key` is there with the value `true`; its other value is `false`.
Result<bool> queryFlag(const Query& query, std::string_view key);

/// The text under `key`; nothing where the query has no such key.
std::optional<std::string_view> queryText(const Query& query, std::string_view key);

} // namespace gnomon
