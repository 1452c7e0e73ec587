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

std::string placesOf(std::size_t places, const std::string& first, const std::string& actual) {
  const std::string what = actual.empty() ? "" : ": " + actual;
  if (places > 1) {
    return " (" + std::to_string(places) + " places, the first is " + (first.empty() ? "/" : first) + what + ")";
  }
  if (first.empty()) return actual.empty() ? "" : " (" + actual + ")";
  return " (" + first + what + ")";
}

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
  refuse({ProblemCode::unsupportedFeature, std::move(pointer), std::move(detail)});
}

void Findings::take(Problems problems) {
  for (Problem& problem : problems) refuse(std::move(problem));
}

void Findings::take(Findings other) {
  take(std::move(other.problems_));
  for (std::string& warning : other.warnings_) warn(std::move(warning));
  for (CountedRepair& each : other.repairs_) {
    if (conformance_ == Conformance::strict) {
      repair(each.kind, each.first, each.limit, each.actual);
    } else {
      count(std::move(each));
    }
  }
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

void Findings::repair(const Repair& kind, const std::string& pointer, const std::string& limit,
                      const std::string& actual) {
  if (conformance_ == Conformance::strict && violations_.size() < kMaxProblems) {
    violations_.push_back(
        {ProblemCode::invalidScene, pointer, kind.fault + ". Without `strict`, " + kind.remedy + ".", limit, actual});
  }
  count({kind, pointer, limit, actual});
}

std::string Findings::leaveOut(Findings part, const std::string& remedy, bool losesTriangles) {
  Problems problems = part.takeProblems();
  take(std::move(part));
  std::string why;
  for (Problem& problem : problems) {
    if (problem.code == ProblemCode::tooLarge) {
      refuse(std::move(problem));
      continue;
    }
    if (why.empty()) why = problem.detail + (problem.pointer.empty() ? "" : " (" + problem.pointer + ")");
    if (problem.detail.ends_with('.')) problem.detail.pop_back();
    repair({std::move(problem.detail), remedy, losesTriangles}, problem.pointer, problem.limit, problem.actual);
  }
  return why;
}

bool Findings::lostTriangles() const {
  return std::ranges::any_of(repairs_, [](const CountedRepair& each) { return each.kind.losesTriangles; });
}

void Findings::refuseRepaired() {
  for (const CountedRepair& each : repairs_) invalid(each.first, each.kind.fault + ".", each.limit, each.actual);
  repairs_.clear();
}

Problems Findings::takeProblems() {
  problems_.insert(problems_.end(), violations_.begin(), violations_.end());
  violations_.clear();
  return std::move(problems_);
}

void Findings::count(CountedRepair repair) {
  const auto known = std::ranges::find(repairs_, repair.kind, &CountedRepair::kind);
  if (known != repairs_.end()) {
    known->places += repair.places;
  } else if (repairs_.size() < kMaxWarnings) {
    repairs_.push_back(std::move(repair));
  } else {
    ++unsaidWarnings_;
  }
}

std::vector<std::string> Findings::takeWarnings() {
  std::vector<std::string> repairs;
  for (const CountedRepair& each : repairs_) {
    repairs.push_back(each.kind.fault + "; " + each.kind.remedy + placesOf(each.places, each.first, each.actual) + ".");
  }
  repairs_.clear();
  warnings_.insert(warnings_.begin(), repairs.begin(), repairs.end());
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
