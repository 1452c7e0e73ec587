#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "tests/renderer/cpu/lanes/lanes_kernels.cpp" // NOLINT: included again for each instruction set
#include "tests/renderer/cpu/lanes/lanes_kernels.h"

#include <hwy/foreach_target.h>

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/vectors-inl.h"
#include "tests/renderer/cpu/lanes/lanes_cases.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

using Number = Float;
using Whole = Int;

void laneCases(const NumberTable& in, NumberTable& out) {
  for (std::size_t row = 0; row < in.rows; row += kLanes) {
    const Float a = load(in.column(0) + row), b = load(in.column(1) + row), c = load(in.column(2) + row);
    const Int i = truncated(a * kWholeScale), j = truncated(b * kWholeScale);
    std::size_t column = 0;
#define GNOMON_STORE_CASE(name, share, expression) store(expression, out.column(column++) + row);
    GNOMON_LANE_CASES(GNOMON_STORE_CASE)
#undef GNOMON_STORE_CASE
  }
}

void laneGroups(const NumberTable& in, NumberTable& out) {
  for (std::size_t row = 0; row < in.rows; row += kLanes) {
    const Float a = load(in.column(0) + row), b = load(in.column(1) + row);
    const Mask less = a < b;
    const auto put = [&](LaneGroupColumn column, const Float& value)
                         HWY_ATTR { store(value, out.column(column) + row); };
    put(kBits, Float(static_cast<float>(bitsOf(less))));
    put(kAny, any(less) ? 1.0f : 0.0f);
    put(kAll, all(less) ? 1.0f : 0.0f);
    put(kNone, none(less) ? 1.0f : 0.0f);
    put(kAgain, select(maskOf(bitsOf(less)), a, b));
    put(kFirst, select(firstLanes(row / kLanes % 17), a, b));
    put(kGathered, gather(in.column(0) + row, Int(15) - laneNumbers()));
    put(kNumber, toFloat(laneNumbers()));
  }
}

void together(const NumberTable& in, NumberTable& out) {
  const float* numbers = in.column(0);
  for (std::size_t row = 0; row < in.rows; row += kLanes) {
    alignas(64) std::int32_t places[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      places[lane] = static_cast<std::int32_t>((row + lane) * kPlaceStep % (in.rows - 3));
    }
    const Int at = load(places);
    Float four[4];
    gatherFours(numbers, at, four);
    for (std::size_t k = 0; k < 4; ++k) store(four[k], out.column(k) + row);
    Int first, second;
    gatherTwos(reinterpret_cast<const std::uint32_t*>(numbers), at, first, second);
    store(floatOf(first), out.column(4) + row);
    store(floatOf(second), out.column(5) + row);
    alignas(64) float rows[4 * kLanes];
    storeFours(four, rows);
    for (std::size_t i = 0; i < 4 * kLanes; ++i) out.column(6 + i % 4)[row + i / 4] = rows[i];
  }
}

void directions(const NumberTable& in, NumberTable& out) {
  for (std::size_t row = 0; row < in.rows; row += kLanes) {
    const Float3 v(load(in.column(0) + row), load(in.column(1) + row), load(in.column(2) + row));
    const Float3 direction = directionOf(v, Float3(glm::vec3(0, 0, 1)));
    store(direction.x, out.column(0) + row);
    store(direction.y, out.column(1) + row);
    store(direction.z, out.column(2) + row);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(laneCases);
GNOMON_EXPORT_KERNEL(laneGroups);
GNOMON_EXPORT_KERNEL(together);
GNOMON_EXPORT_KERNEL(directions);

NumberTable casesByLanes(const NumberTable& in) {
#define GNOMON_COUNT_CASE(name, share, expression) +1
  NumberTable out(in.rows, std::size_t{0 GNOMON_LANE_CASES(GNOMON_COUNT_CASE)});
#undef GNOMON_COUNT_CASE
  GNOMON_KERNEL(laneCases)(in, out);
  return out;
}

NumberTable groupsByLanes(const NumberTable& in) {
  NumberTable out(in.rows, kLaneGroupColumns);
  GNOMON_KERNEL(laneGroups)(in, out);
  return out;
}

NumberTable togetherByLanes(const NumberTable& in) {
  NumberTable out(in.rows, kTogetherColumns);
  GNOMON_KERNEL(together)(in, out);
  return out;
}

NumberTable directionsByLanes(const NumberTable& in) {
  NumberTable out(in.rows, 3);
  GNOMON_KERNEL(directions)(in, out);
  return out;
}

} // namespace gnomon::cpu
#endif
