#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

/// What becomes of a file that violates glTF where its picture is still clear.
enum class Conformance {
  repaired, ///< it is repaired, with a warning
  strict    ///< it is refused
};

/// A kind of fault and its remedy, as parts of a sentence: {"A number is beyond its limit by rounding", "it is brought
/// to the limit"}.
struct Repair {
  std::string fault;
  std::string remedy;
  bool losesTriangles = false; ///< something that the file has is not drawn

  bool operator==(const Repair&) const = default;
};

/// Problems, which refuse a file, and warnings, which say what is drawn differently; both capped.
class Findings {
 public:
  explicit Findings(Conformance conformance = Conformance::repaired) : conformance_(conformance) {}

  void refuse(Problem problem);
  void invalid(std::string pointer, std::string detail, std::string limit = {}, std::string actual = {});
  void tooLarge(std::string pointer, std::string detail, std::string limit, std::string actual);
  void unsupported(std::string pointer, std::string detail);
  void take(Problems problems);
  void take(Findings other); ///< as if all of it had been found here

  /// One sentence; said once, however often it is reported.
  void warn(std::string sentence);

  /// A violation that is safe to read: one warning a kind, which counts the places and names the first; a problem where
  /// the file has to conform.
  void repair(const Repair& kind, const std::string& pointer, const std::string& limit = {},
              const std::string& actual = {});

  /// Takes the findings of a part that is left out: its problems become repairs with `remedy`, but for limits, which
  /// refuse. Returns the first problem; empty = the part is sound.
  std::string leaveOut(Findings part, const std::string& remedy, bool losesTriangles = false);

  /// Whether a repair lost triangles.
  bool lostTriangles() const;
  /// Turns repairs into problems: they left nothing that would be worth drawing.
  void refuseRepaired();

  bool refused() const { return !problems_.empty(); }
  /// Whether the file has to conform and does not. That ends nothing early, so that all of it is found.
  bool violated() const { return !violations_.empty(); }
  std::size_t count() const { return problems_.size() + warnings_.size() + repairs_.size() + unsaidWarnings_; }
  Problems takeProblems();                 ///< violations last
  std::vector<std::string> takeWarnings(); ///< repairs first

 private:
  struct CountedRepair {
    Repair kind;
    std::string first; ///< pointer
    std::string limit{};
    std::string actual{};
    std::size_t places = 1;
  };
  void count(CountedRepair repair);

  Conformance conformance_;
  Problems problems_;
  Problems violations_; ///< what is no conforming file's, where it has to be one
  std::vector<CountedRepair> repairs_;
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
