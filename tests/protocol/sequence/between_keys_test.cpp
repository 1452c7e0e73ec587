#include "protocol/sequence/between_keys.h"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon {
namespace {

/// A spec's members that are interpolated.
Json movedSpec() {
  const auto number = [] {
    return *rc::gen::map(rc::gen::inRange(-1'000'000, 1'000'000), [](int n) { return n / 7.0; });
  };
  return {{"camera", {{"eye", {number(), number(), number()}}, {"target", {0, 0, 0}}, {"up", {0, 1, 0}}}},
          {"exposure", number()},
          {"lights", {{{"type", "directional"}, {"direction", {number(), number(), number()}}}}},
          {"toneMapping", "aces"}};
}

void expectBetween(const Json& a, const Json& b, const Json& middle) {
  if (a.is_number()) {
    RC_ASSERT(middle.get<double>() >= std::min(a.get<double>(), b.get<double>()));
    RC_ASSERT(middle.get<double>() <= std::max(a.get<double>(), b.get<double>()));
    return;
  }
  RC_ASSERT(a.size() == middle.size());
  if (!a.is_structured()) RC_ASSERT(a == middle);
  if (a.is_array()) {
    for (std::size_t i = 0; i < a.size(); ++i) expectBetween(a[i], b[i], middle[i]);
  } else if (a.is_object()) {
    for (const auto& [key, value] : a.items()) expectBetween(value, b[key], middle[key]);
  }
}

RC_GTEST_PROP(BetweenKeys, EveryNumberLiesBetweenThoseOfBothKeysAndNothingElseChanges, ()) {
  const Json a = movedSpec();
  const Json b = movedSpec();
  ProblemList problems;
  checkNeighbours(a, b, Place(), problems);
  RC_ASSERT(problems.empty());
  expectBetween(a, b, between(a, b, *rc::gen::inRange(0, 1001) / 1000.0));
}

RC_GTEST_PROP(BetweenKeys, BothEndsAreTheKeysAndEqualKeysStay, ()) {
  const Json a = movedSpec();
  const Json b = movedSpec();
  RC_ASSERT(between(a, b, 0) == a);
  RC_ASSERT(between(a, b, 1) == b);
  RC_ASSERT(between(a, a, *rc::gen::inRange(0, 1001) / 1000.0) == a);
}

RC_GTEST_PROP(BetweenKeys, StepsAreEqual, ()) {
  const Json a = movedSpec();
  const Json b = movedSpec();
  const int steps = *rc::gen::inRange(2, 100);
  const double step = (b["exposure"].get<double>() - a["exposure"].get<double>()) / steps;
  for (int i = 0; i < steps; ++i) {
    const double here = between(a, b, double(i) / steps)["exposure"].get<double>();
    const double next = between(a, b, double(i + 1) / steps)["exposure"].get<double>();
    RC_ASSERT(std::abs(next - here - step) <= 1e-9 * (1 + std::abs(step) * steps + std::abs(here)));
  }
}

TEST(BetweenKeys, TimeOfASunPasses) {
  const auto key = [](const char* time, const char* variant) {
    return Json{{"lights", {{{"sun", {{"latitudeDegrees", 48.1}, {"longitudeDegrees", 11.6}, {"time", time}}}}}},
                {"materialVariant", variant}};
  };
  const Json dawn = key("2026-06-21T05:00+02:00", "a");
  const Json dusk = key("2026-06-21T21:00+02:00", "a");
  ProblemList problems;
  checkNeighbours(dawn, dusk, Place(), problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(between(dawn, dusk, 0.25)["lights"][0]["sun"]["time"], "2026-06-21T09:00:00+02:00");

  // Of other texts none passes, whatever it looks like, and a time that can't be read doesn't either.
  checkNeighbours(key("2026-06-21T05:00Z", "2026-06-21T05:00Z"), key("2026-06-21T05:00Z", "2026-06-21T06:00Z"), Place(),
                  problems);
  checkNeighbours(key("dawn", "a"), key("2026-06-21T05:00Z", "a"), Place(), problems);
  ASSERT_EQ(problems.problems().size(), 2u);
  EXPECT_EQ(problems.problems()[0].pointer, "/materialVariant");
  EXPECT_EQ(problems.problems()[1].pointer, "/lights/0/sun/time");
}

} // namespace
} // namespace gnomon
