#pragma once

#include "protocol/base/result.h"
#include "tests/fuzz/require.h"

namespace gnomon::fuzz {

/// Bad input is told as such: with a sentence, and never as a mistake of our own.
inline void requireSound(const Problems& problems) {
  require(!problems.empty(), "a refusal has a problem");
  for (const Problem& problem : problems) {
    require(problem.code != ProblemCode::internal, "bad input is no mistake of our own");
    require(!problem.detail.empty(), "a problem says what it is");
  }
}

} // namespace gnomon::fuzz
