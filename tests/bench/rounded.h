#pragma once

#include <cstdio>
#include <string>

namespace gnomon::bench {

inline std::string rounded(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

} // namespace gnomon::bench
