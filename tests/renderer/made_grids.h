#pragma once

#include <functional>
#include <string>

#include "protocol/base/bytes.h"

namespace gnomon::testing {

/// A .npy of bytes, one a voxel: `value(x, y, z)` from 0 to 255.
inline Bytes byteGrid(int x, int y, int z, const std::function<int(int, int, int)>& value) {
  std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (" + std::to_string(z) + ", " +
                       std::to_string(y) + ", " + std::to_string(x) + "), }";
  header += std::string(63 - (header.size() + 10) % 64, ' ') + "\n";
  std::string file = std::string("\x93NUMPY\x01\x00", 8);
  file += static_cast<char>(header.size() & 255);
  file += static_cast<char>(header.size() >> 8);
  file += header;
  for (int k = 0; k < z; ++k) {
    for (int j = 0; j < y; ++j) {
      for (int i = 0; i < x; ++i) file += static_cast<char>(value(i, j, k));
    }
  }
  return Bytes(file.begin(), file.end());
}

} // namespace gnomon::testing
