#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace gnomon {

/// Three digits of a number: "7.07", "0.00012", "1.23e+05".
inline std::string warnedNumber(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

} // namespace gnomon
