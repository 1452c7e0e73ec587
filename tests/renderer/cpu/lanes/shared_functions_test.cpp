#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>
#include <vector>

#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/lanes/shared_functions_kernels.h"
#include "tests/renderer/cpu/number_table.h"

const glm::vec4* gnomon::cpu::wavyEnvironment() {
  static const std::vector<glm::vec4> texels = [] {
    std::vector<glm::vec4> made;
    for (int y = 0; y < GNOMON_ENVIRONMENT_HEIGHT; ++y) {
      for (int x = 0; x < GNOMON_ENVIRONMENT_WIDTH; ++x) {
        made.emplace_back(1 + std::sin(0.3f * float(x)), 1 + std::cos(0.2f * float(y)),
                          1 + std::sin(0.1f * float(x + y)), 1);
      }
    }
    return made;
  }();
  return texels.data();
}

namespace gnomon::shared {
namespace {

#include "tests/renderer/cpu/lanes/shared_functions_cases.h"

struct Columns {
  const cpu::NumberTable& table;
  std::size_t row;

  float one(std::size_t column) const { return table.at(row, column); }
  vec3 three(std::size_t column) const { return {one(column), one(column + 1), one(column + 2)}; }
};

template <class... Cases>
vec3 byNumbers(std::size_t which, const Columns& in) {
  using Case = vec3 (*)(const Columns&);
  constexpr Case cases[] = {&Cases::template of<Columns>...};
  return cases[which](in);
}

/// Largest difference, as a share of the result where that is above 1.
float largestDifference(const cpu::NumberTable& in, const cpu::NumberTable& lanes, std::size_t which) {
  float largest = 0;
  for (std::size_t row = 0; row < in.rows; ++row) {
    const vec3 expected = byNumbers<GNOMON_SHARED_FUNCTION_CASES>(which, {in, row});
    for (int axis = 0; axis < 3; ++axis) {
      const float off = std::abs(lanes.at(row, static_cast<std::size_t>(axis)) - expected[axis]);
      const float share = off / std::max(1.0f, std::abs(expected[axis]));
      if (!(share <= largest)) largest = share; // not a number counts
    }
  }
  return largest;
}

TEST(SharedFunctions, LanesGiveWhatSingleNumbersGive) {
  constexpr std::size_t kRows = 100'000;
  const cpu::NumberTable in = cpu::randomNumbers(kRows, cpu::kSharedFunctionInputs, -1.0f, 1.0f);
  cpu::onEachInstructionSet([&] {
    for (std::size_t which = 0; which < cpu::sharedFunctionNames.size(); ++which) {
      cpu::NumberTable out(kRows, cpu::kSharedFunctionOutputs);
      cpu::sharedFunctionByLanes(which, kRows, in.column(0), out.column(0));
      EXPECT_LE(largestDifference(in, out, which), 1e-3f) << cpu::sharedFunctionNames[which];
    }
  });
}

TEST(SharedFunctions, OctahedralDirectionsComeBackFromTwice16Bits) {
  constexpr std::size_t kRows = 10'000;
  const cpu::NumberTable in = cpu::randomNumbers(kRows, 3, -1.0f, 1.0f);
  for (std::size_t row = 0; row < kRows; ++row) {
    const vec3 direction = in.triple(row, 0);
    const vec3 back = fromOctahedral(glm::unpackSnorm2x16(glm::packSnorm2x16(octahedral(direction))));
    EXPECT_LT(glm::length(back - normalize(direction)), 7e-5f) << row;
  }
}

} // namespace
} // namespace gnomon::shared
