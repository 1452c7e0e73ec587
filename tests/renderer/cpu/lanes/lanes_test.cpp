#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>

#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/lanes/lanes_cases.h"
#include "tests/renderer/cpu/lanes/lanes_kernels.h"

namespace gnomon::cpu {
namespace {

/// The names of lanes-inl.h, for one number at a time.
namespace single {

using Number = float;
using Whole = std::int32_t;

using std::abs;
using std::ceil;
using std::clamp;
using std::cos;
using std::exp;
using std::exp2;
using std::floor;
using std::log2;
using std::max;
using std::min;
using std::sin;
using std::sqrt;

float fract(float a) {
  return a - floor(a);
}
float inversesqrt(float a) {
  return 1.0f / sqrt(a);
}
float mulAdd(float a, float b, float c) {
  return std::fma(a, b, c);
}
float mix(float a, float b, float share) {
  return a * (1.0f - share) + b * share;
}
float smoothstep(float low, float high, float at) {
  const float t = clamp((at - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}
float toFloat(Whole a) {
  return static_cast<float>(a);
}
Whole truncated(float a) {
  return static_cast<Whole>(a);
}
Whole nearest(float a) {
  return static_cast<Whole>(std::nearbyint(a));
}
Whole bitsOf(float a) {
  return std::bit_cast<Whole>(a);
}
float floatOf(Whole a) {
  return std::bit_cast<float>(a);
}
template <class T>
T select(bool where, T yes, T no) {
  return where ? yes : no;
}
bool andNot(bool without, bool a) {
  return !without && a;
}
template <int bits>
Whole shiftLeft(Whole a) {
  return static_cast<Whole>(static_cast<std::uint32_t>(a) << bits);
}
template <int bits>
Whole shiftRight(Whole a) {
  return a >> bits;
}
template <int bits>
Whole shiftRightUnsigned(Whole a) {
  return static_cast<Whole>(static_cast<std::uint32_t>(a) >> bits);
}

struct Case {
  const char* name;
  float share;
  float (*of)(float a, float b, float c);
};

#define GNOMON_SINGLE_CASE(name, share, expression)                                                 \
  {#name, share, []([[maybe_unused]] float a, [[maybe_unused]] float b, [[maybe_unused]] float c) { \
     [[maybe_unused]] const Whole i = truncated(a * kWholeScale), j = truncated(b * kWholeScale);   \
     return static_cast<float>(expression);                                                         \
   }},
const Case kCases[] = {GNOMON_LANE_CASES(GNOMON_SINGLE_CASE)};
#undef GNOMON_SINGLE_CASE

} // namespace single

constexpr std::size_t kRows = 100'000;

TEST(CpuLanes, GiveWhatSingleNumbersGive) {
  const NumberTable in = randomNumbers(kRows, 3, -20.0f, 20.0f);
  onEachInstructionSet([&] {
    const NumberTable out = casesByLanes(in);
    ASSERT_EQ(out.columns(), std::size(single::kCases));
    for (std::size_t column = 0; column < out.columns(); ++column) {
      const single::Case& own = single::kCases[column];
      std::size_t off = 0;
      for (std::size_t row = 0; row < kRows; ++row) {
        const float expected = own.of(in.at(row, 0), in.at(row, 1), in.at(row, 2));
        const float allowed = own.share * std::max(1.0f, std::abs(expected));
        off += std::abs(out.at(row, column) - expected) <= allowed ? 0 : 1; // not a number counts
      }
      EXPECT_EQ(off, 0u) << own.name;
    }
  });
}

TEST(CpuLanes, KnowWhatTheySayTogether) {
  // Of some sixteen all or none are less.
  NumberTable in = randomNumbers(kRows, 2, -1.0f, 1.0f);
  for (std::size_t row = 0; row < kRows; ++row) {
    if (row / 16 % 5 < 2) in.column(1)[row] = row / 16 % 5 == 0 ? 2.0f : -2.0f;
  }
  onEachInstructionSet([&] {
    const NumberTable out = groupsByLanes(in);
    for (std::size_t first = 0; first < kRows; first += 16) {
      unsigned bits = 0;
      for (std::size_t lane = 0; lane < 16; ++lane) {
        bits |= in.at(first + lane, 0) < in.at(first + lane, 1) ? 1u << lane : 0u;
      }
      for (std::size_t lane = 0; lane < 16; ++lane) {
        const std::size_t row = first + lane;
        const float a = in.at(row, 0), b = in.at(row, 1);
        ASSERT_EQ(out.at(row, kBits), static_cast<float>(bits));
        ASSERT_EQ(out.at(row, kAny) == 1.0f, bits != 0);
        ASSERT_EQ(out.at(row, kAll) == 1.0f, bits == 0xffff);
        ASSERT_EQ(out.at(row, kNone) == 1.0f, bits == 0);
        ASSERT_EQ(out.at(row, kAgain), std::min(a, b));
        ASSERT_EQ(out.at(row, kFirst), lane < first / 16 % 17 ? a : b);
        ASSERT_EQ(out.at(row, kGathered), in.at(first + 15 - lane, 0));
        ASSERT_EQ(out.at(row, kNumber), static_cast<float>(lane));
      }
    }
  });
}

TEST(CpuLanes, ReadWhatLiesTogether) {
  const NumberTable in = randomNumbers(kRows, 1, -1.0f, 1.0f);
  onEachInstructionSet([&] {
    const NumberTable out = togetherByLanes(in);
    for (std::size_t row = 0; row < kRows; ++row) {
      const std::size_t place = row * kPlaceStep % (kRows - 3);
      for (std::size_t column = 0; column < kTogetherColumns; ++column) {
        const std::size_t behind = column < 6 ? column % 4 : column - 6;
        ASSERT_EQ(out.at(row, column), in.at(place + behind, 0)) << row << ' ' << column;
      }
    }
  });
}

/// Vectors of 1e-33 to 1e33, some of them flat.
NumberTable vectorsOfAnySize() {
  NumberTable in = randomNumbers(kRows, 4, -1.0f, 1.0f);
  for (std::size_t row = 0; row < kRows; ++row) {
    const float size = std::pow(10.0f, 33.0f * in.at(row, 3));
    for (std::size_t axis = 0; axis < 3; ++axis) in.column(axis)[row] *= row % 7 == axis ? 0.0f : size;
  }
  return in;
}

TEST(CpuLanes, DirectionsHaveUnitLengthWhateverTheSize) {
  const NumberTable in = vectorsOfAnySize();
  onEachInstructionSet([&] {
    const NumberTable out = directionsByLanes(in);
    for (std::size_t row = 0; row < kRows; ++row) {
      const glm::dvec3 expected = glm::normalize(glm::dvec3(in.triple(row, 0)));
      ASSERT_LT(glm::length(glm::dvec3(out.triple(row, 0)) - expected), 1e-6) << row;
    }
  });
}

TEST(CpuLanes, ADirectionIsTheSameBitsWhateverIsBesideIt) {
  NumberTable in = randomNumbers(kRows, 4, -1.0f, 1.0f);
  for (std::size_t row = 0; row < kRows; ++row) {
    const float size = std::pow(10.0f, 9.0f * in.at(row, 3));
    for (std::size_t axis = 0; axis < 3; ++axis) in.column(axis)[row] *= size;
  }
  NumberTable beside = in; // of each sixteen the last is too large for its square, has no direction or is no number
  constexpr float kOdd[] = {1e25f, 0.0f, std::numeric_limits<float>::quiet_NaN()};
  for (std::size_t row = 15; row < kRows; row += 16) beside.column(row / 16 % 3)[row] = kOdd[row / 16 % 3];
  for (std::size_t row = 31; row < kRows; row += 48) beside.column(0)[row] = beside.column(2)[row] = 0;
  onEachInstructionSet([&] {
    const NumberTable alone = directionsByLanes(in);
    const NumberTable mixed = directionsByLanes(beside);
    std::size_t differ = 0;
    for (std::size_t row = 0; row < kRows; ++row) {
      for (std::size_t axis = 0; axis < 3 && row % 16 != 15; ++axis) {
        differ += alone.at(row, axis) == mixed.at(row, axis) ? 0 : 1;
      }
    }
    EXPECT_EQ(differ, 0u);
  });
}

} // namespace
} // namespace gnomon::cpu
