#pragma once

#include <cstddef>
#include <string>

#include "protocol/base/result.h"

namespace gnomon {

/// Collects what is wrong with an input, up to a bound, so that a hostile one can't grow the reply without end.
class ProblemList {
 public:
  static constexpr std::size_t kMax = 32;

  void add(Problem problem) {
    if (problems_.size() < kMax) {
      problems_.push_back(std::move(problem));
    } else {
      ++leftOut_;
    }
  }

  bool empty() const { return problems_.empty(); }
  const Problems& problems() const { return problems_; }

  /// Everything collected, and how many more there were.
  Problems take() && {
    if (leftOut_ > 0) {
      problems_.push_back({.code = ProblemCode::invalidValue,
                           .detail = "There are more problems than are listed here.",
                           .limit = std::to_string(kMax),
                           .actual = std::to_string(kMax + leftOut_)});
    }
    return std::move(problems_);
  }

 private:
  Problems problems_;
  std::size_t leftOut_ = 0;
};

} // namespace gnomon
