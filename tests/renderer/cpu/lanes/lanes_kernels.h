#pragma once

#include "tests/renderer/cpu/number_table.h"

namespace gnomon::cpu {

/// A column for each of GNOMON_LANE_CASES. `in`: a, b and c; i and j are a and b times kWholeScale, truncated.
NumberTable casesByLanes(const NumberTable& in);
inline constexpr float kWholeScale = 1000.0f;

/// What sixteen lanes say of themselves together; a row each. `in`: a and b.
enum LaneGroupColumn : std::size_t {
  kBits, // of a < b
  kAny,  // whether any, all and none of the lanes have a < b: 1 or 0
  kAll,
  kNone,
  kAgain,    // a where a bit of kBits is set, b elsewhere
  kFirst,    // a in the first lanes, as many as the row's place among the sixteen; b in the others
  kGathered, // a of the sixteen rows, the last one first
  kNumber,   // the lane's number
  kLaneGroupColumns
};
NumberTable groupsByLanes(const NumberTable& in);

/// Numbers that lie together: those that gatherFours reads, four columns; gatherTwos, two; and what storeFours makes of
/// the four, four again. `in`: a, read from row `row` * kPlaceStep, modulo all but three of the rows, on.
inline constexpr std::size_t kPlaceStep = 7919;
inline constexpr std::size_t kTogetherColumns = 10;
NumberTable togetherByLanes(const NumberTable& in);

/// directionOf, three columns; 0, 0, 1 where there is none. `in`: x, y and z.
NumberTable directionsByLanes(const NumberTable& in);

} // namespace gnomon::cpu
