#include "renderer/scene/findings.h"

#include <algorithm>

#include "protocol/base/json.h"
#include "protocol/base/text.h"

namespace gnomon {

namespace {

constexpr std::size_t kMaxProblems = 32;
constexpr std::size_t kMaxWarnings = 64;
constexpr std::size_t kMaxQuotedBytes = 80;
constexpr std::size_t kMaxNameBytes = 256;

} // namespace

void Findings::refuse(Problem problem) {
  if (problems_.size() < kMaxProblems) problems_.push_back(std::move(problem));
}

void Findings::invalid(std::string pointer, std::string detail, std::string limit, std::string actual) {
  refuse({ProblemCode::invalidScene, std::move(pointer), std::move(detail), std::move(limit), std::move(actual)});
}

void Findings::tooLarge(std::string pointer, std::string detail, std::string limit, std::string actual) {
  refuse({ProblemCode::tooLarge, std::move(pointer), std::move(detail), std::move(limit), std::move(actual)});
}

void Findings::unsupported(std::string pointer, std::string detail) {
  refuse({ProblemCode::unsupportedFeature, std::move(pointer), std::move(detail), {}, {}});
}

void Findings::take(Problems problems) {
  for (Problem& problem : problems) refuse(std::move(problem));
}

void Findings::take(Findings other) {
  take(std::move(other.problems_));
  for (std::string& warning : other.warnings_) warn(std::move(warning));
  unsaidWarnings_ += other.unsaidWarnings_;
}

void Findings::warn(std::string sentence) {
  if (std::find(warnings_.begin(), warnings_.end(), sentence) != warnings_.end()) return;
  if (warnings_.size() < kMaxWarnings) {
    warnings_.push_back(std::move(sentence));
  } else {
    ++unsaidWarnings_;
  }
}

std::vector<std::string> Findings::takeWarnings() {
  if (unsaidWarnings_ > 0) {
    warnings_.push_back("There are " + std::to_string(unsaidWarnings_) + " further warnings.");
    unsaidWarnings_ = 0;
  }
  return std::move(warnings_);
}

std::string inQuotes(std::string_view text) {
  if (text.size() <= kMaxQuotedBytes) return '"' + std::string(text) + '"';
  return '"' + std::string(beginningOf(text, kMaxQuotedBytes)) + "...\"";
}

std::string keptName(std::string_view name, Findings& findings) {
  if (name.size() <= kMaxNameBytes) return std::string(name);
  findings.warn("The name " + inQuotes(name) + " is cut to " + std::to_string(kMaxNameBytes) + " bytes.");
  return std::string(beginningOf(name, kMaxNameBytes));
}

std::string pointerTo(const std::string& parent, std::string_view key) {
  return parent + '/' + escapedToken(key);
}

std::string pointerTo(const std::string& parent, std::size_t index) {
  return parent + '/' + std::to_string(index);
}

} // namespace gnomon
