#pragma once

#include <string>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

/// What reading a file turned up: problems, which refuse it, and warnings, which tell what is drawn differently.
/// Both are capped, so that a hostile file can't make its report larger than itself.
class Findings {
 public:
  void refuse(Problem problem);
  void invalid(std::string pointer, std::string detail, std::string limit = {}, std::string actual = {});
  void tooLarge(std::string pointer, std::string detail, std::string limit, std::string actual);
  void unsupported(std::string pointer, std::string detail);
  void take(Problems problems);
  void take(Findings other); ///< as if all of it had been found here

  /// One sentence; said once, however often it is reported.
  void warn(std::string sentence);

  bool refused() const { return !problems_.empty(); }
  std::size_t count() const { return problems_.size() + warnings_.size() + unsaidWarnings_; }
  Problems takeProblems() { return std::move(problems_); }
  std::vector<std::string> takeWarnings();

 private:
  Problems problems_;
  std::vector<std::string> warnings_;
  std::size_t unsaidWarnings_ = 0;
};

/// A user's text in quotes, shortened to something that fits a sentence.
std::string inQuotes(std::string_view text);

/// A name as it is kept: many nodes may share a camera with a very long name, so that it is cut, with a warning.
std::string keptName(std::string_view name, Findings& findings);

/// `parent` + "/" + `key`, escaped as RFC 6901 asks.
std::string pointerTo(const std::string& parent, std::string_view key);
std::string pointerTo(const std::string& parent, std::size_t index);

} // namespace gnomon
