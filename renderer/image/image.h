#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "protocol/base/bytes.h"

namespace gnomon {

/// Pixels, interleaved, first row on top. 8 bits: 0..255, 16 bits: 0..65535, sRGB where it is a colour; float: linear.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels; ///< in order, e.g. {"R","G","B","A"}, {"Z"}
  std::variant<std::vector<std::uint8_t>, std::vector<float>, std::vector<std::uint16_t>> pixels;
};

} // namespace gnomon
