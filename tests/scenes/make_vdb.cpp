#include <cmath>
#include <fstream>

#include "tests/renderer/volume/vdb_builder.h"

/// Writes a ball of 24 voxels across, 5 in its middle and 0 at its edge, as the grid "density" of an OpenVDB file.
int main(int, char** arguments) {
  constexpr int kRadius = 12;
  gnomon::VdbGrid ball{"density", {}};
  for (int z = -kRadius; z < kRadius; ++z) {
    for (int y = -kRadius; y < kRadius; ++y) {
      for (int x = -kRadius; x < kRadius; ++x) {
        const float distance = std::hypot(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f) / kRadius;
        if (distance < 1) ball.voxels.push_back({{x, y, z}, 5 * (1 - distance)});
      }
    }
  }
  std::ofstream file(arguments[1], std::ios::binary);
  file << gnomon::vdbFile({ball});
  return file ? 0 : 1;
}
