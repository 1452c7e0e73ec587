#include "renderer/techniques/neighbours.h"

#include "renderer/core/instruction_sets.h"

namespace gnomon {
namespace {

std::uint8_t lesser(std::uint8_t a, std::uint8_t b) {
  return a < b ? a : b;
}
std::uint8_t greater(std::uint8_t a, std::uint8_t b) {
  return a > b ? a : b;
}

} // namespace

GNOMON_FOR_EACH_INSTRUCTION_SET void extremesAround(const ThreeRows& rows, std::size_t width, std::uint8_t* least,
                                                    std::uint8_t* most) {
  const auto [below, own, above] = rows;
  for (std::size_t x = 0; x < width; ++x) {
    least[x + 1] = lesser(lesser(below[x], above[x]), own[x]);
    most[x + 1] = greater(greater(below[x], above[x]), own[x]);
  }
  least[0] = least[1];
  most[0] = most[1];
  least[width + 1] = least[width];
  most[width + 1] = most[width];
  // What is read here lies at or behind what is written.
  for (std::size_t x = 0; x < width; ++x) {
    least[x] = lesser(lesser(least[x], least[x + 1]), least[x + 2]);
    most[x] = greater(greater(most[x], most[x + 1]), most[x + 2]);
  }
}

} // namespace gnomon
