#pragma once

#include <cstdio>
#include <cstdlib>

namespace gnomon::fuzz {

/// Ends the program, which the fuzzer counts as a crash, where something does not hold.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

} // namespace gnomon::fuzz
