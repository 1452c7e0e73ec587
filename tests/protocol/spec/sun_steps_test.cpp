#include "protocol/spec/sun_steps.h"

#include <gtest/gtest.h>

#include "protocol/spec/settled_sun.h"
#include "tests/protocol/found_problems.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

SunHours munichFrom(const char* begin, const char* end) {
  return {.latitudeDegrees = 48.1, .longitudeDegrees = 11.6, .begin = begin, .end = end};
}

double hoursOf(const SunHours& asked) {
  double hours = 0;
  for (const SunStep& step : sunSteps(asked)) hours += step.hours;
  return hours;
}

Problems problemsOf(const SunHours& asked) {
  FrameSpec spec;
  spec.views = {View::sunHours};
  spec.sunHours = asked;
  return validate(spec);
}

std::vector<std::string> wrongIn(const SunHours& asked) {
  return pointersOf(problemsOf(asked));
}

// Published: 05:13 to 21:17, by the sun's upper edge; its centre rises 2.5 minutes later.
TEST(SunSteps, AMidsummerDayIsAsLongAsAlmanacsHaveIt) {
  const SunHours day = munichFrom("2026-06-21T00:00+02:00", "2026-06-22T00:00+02:00");
  EXPECT_EQ(sunStepCount(day), 144);
  EXPECT_NEAR(hoursOf(day), 16 + 4 / 60.0, 10 / 60.0);
}

TEST(SunSteps, AtNightThereAreNone) {
  EXPECT_TRUE(sunSteps(munichFrom("2026-06-21T23:00+02:00", "2026-06-22T02:00+02:00")).empty());
}

TEST(SunSteps, TheSunStandsWhereItIsInTheMiddleOfTheStep) {
  SunHours noon = munichFrom("2026-06-21T12:00+02:00", "2026-06-21T13:00+02:00");
  noon.stepMinutes = 60;
  noon.northDegrees = 20;
  const auto steps = sunSteps(noon);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].hours, 1);
  EXPECT_EQ(
      steps[0].sun,
      settledSun(
          {.latitudeDegrees = 48.1, .longitudeDegrees = 11.6, .time = "2026-06-21T12:30+02:00", .northDegrees = 20.0}));
}

TEST(SunSteps, TheLastStepIsAsLongAsWhatIsLeft) {
  SunHours noon = munichFrom("2026-06-21T12:00+02:00", "2026-06-21T13:15+02:00");
  noon.stepMinutes = 30;
  EXPECT_EQ(sunStepCount(noon), 3);
  const auto steps = sunSteps(noon);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[2].hours, 0.25);
}

TEST(SunSteps, ADayStandsForThoseThatFollow) {
  SunHours ten = munichFrom("2026-06-01T00:00Z", "2026-06-11T00:00Z");
  ten.stepDays = 7;
  SunHours first = ten, eighth = ten;
  first.stepDays = eighth.stepDays = 1;
  first.end = "2026-06-02T00:00Z";
  eighth.begin = "2026-06-08T00:00Z";
  eighth.end = "2026-06-09T00:00Z";
  EXPECT_EQ(sunStepCount(ten), 2 * 144);
  EXPECT_NEAR(hoursOf(ten), 7 * hoursOf(first) + 3 * hoursOf(eighth), 1e-9);
}

TEST(SunSteps, OneDayOfAWeekIsEnoughForAYear) {
  SunHours year = munichFrom("2026-01-01T00:00+01:00", "2027-01-01T00:00+01:00");
  year.stepDays = 7;
  EXPECT_THAT(wrongIn(year), IsEmpty());
  SunHours daily = year;
  daily.stepDays = 1;
  daily.stepMinutes = 60;
  EXPECT_NEAR(hoursOf(year), hoursOf(daily), 0.002 * hoursOf(daily));
}

TEST(SunSteps, WhatIsMissingOrReversedIsNamed) {
  EXPECT_THAT(wrongIn(SunHours{}), UnorderedElementsAre("/sunHours/latitudeDegrees", "/sunHours/longitudeDegrees",
                                                        "/sunHours/begin", "/sunHours/end"));
  EXPECT_THAT(wrongIn(munichFrom("2026-06-21T12:00+02:00", "2026-06-21T10:00Z")), ElementsAre("/sunHours/end"));
  EXPECT_THAT(wrongIn(munichFrom("2026-06-21T12:00", "2026-06-31T12:00Z")),
              UnorderedElementsAre("/sunHours/begin", "/sunHours/end"));
  FrameSpec spec;
  spec.views = {View::sunHours};
  EXPECT_THAT(pointersOf(validate(spec)), ElementsAre("/sunHours"));
}

TEST(SunSteps, DaysThatStandForOthersAreWhole) {
  SunHours part = munichFrom("2026-06-01T00:00Z", "2026-06-10T12:00Z");
  EXPECT_THAT(wrongIn(part), IsEmpty());
  part.stepDays = 2;
  EXPECT_THAT(wrongIn(part), ElementsAre("/sunHours/end"));
}

TEST(SunSteps, TooManyNameTheLimit) {
  SunHours many = munichFrom("2026-01-01T00:00Z", "2026-01-11T00:00Z");
  many.stepMinutes = 1.44; // 1000 a day
  EXPECT_THAT(wrongIn(many), IsEmpty());
  many.end = "2026-01-11T00:01Z";
  const Problems problems = problemsOf(many);
  ASSERT_THAT(pointersOf(problems), ElementsAre("/sunHours"));
  EXPECT_EQ(problems[0].limit, "at most 10000 steps");
  EXPECT_EQ(problems[0].actual, "10001");
}

} // namespace
} // namespace gnomon
