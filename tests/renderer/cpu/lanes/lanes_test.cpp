#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

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

} // namespace
} // namespace gnomon::cpu
