#include "clients/cli/spec/sun_text.h"

#include <gtest/gtest.h>

#include "clients/cli/spec/spec_arguments.h"
#include "protocol/sun/moment.h"

namespace gnomon::cli {
namespace {

TEST(SunText, ASunStandsByAnglesOrByPlaceAndTime) {
  EXPECT_EQ(sunOf("135,40"), (Sun{.azimuthDegrees = 135, .elevationDegrees = 40}));
  EXPECT_EQ(sunOf("48.1,-11.6 2026-06-21T17:00+02:00"),
            (Sun{.latitudeDegrees = 48.1, .longitudeDegrees = -11.6, .time = "2026-06-21T17:00+02:00"}));
  for (const char* text : {"", "135", "135,40,2", "135;40", "north 2026-06-21T17:00Z", " 1,2"}) {
    EXPECT_FALSE(sunOf(text)) << text;
  }
}

TEST(SunText, HoursOfADateGoFromMidnightToMidnightByTheMeanSun) {
  EXPECT_EQ(sunHoursOf("48.1,15 2026-06-30"), (SunHours{.latitudeDegrees = 48.1,
                                                        .longitudeDegrees = 15,
                                                        .begin = "2026-06-30T00:00:00+01:00",
                                                        .end = "2026-07-01T00:00:00+01:00"}));
  EXPECT_EQ(sunHoursOf("-33.9,-70.65 2026-12-31")->begin, "2026-12-31T00:00:00-04:43"); // 282.6 minutes behind
  for (const double longitude : {-180.0, -0.1, 0.0, 11.6, 179.99}) {
    const auto hours = sunHoursOf("10," + std::to_string(longitude) + " 2026-03-01");
    ASSERT_TRUE(hours) << longitude;
    const auto begin = readMoment(hours->begin), end = readMoment(hours->end);
    ASSERT_TRUE(begin && end) << hours->begin << ' ' << hours->end;
    EXPECT_EQ(end->milliseconds - begin->milliseconds, 86'400'000) << longitude;
    EXPECT_NEAR(begin->zoneMinutes, 4 * longitude, 0.5);
  }
}

TEST(SunText, HoursBetweenTwoMomentsAreDatesOrTimes) {
  EXPECT_EQ(sunHoursOf("0,0 2026-01-01/2027-01-01"), (SunHours{.latitudeDegrees = 0,
                                                               .longitudeDegrees = 0,
                                                               .begin = "2026-01-01T00:00:00Z",
                                                               .end = "2027-01-01T00:00:00Z"}));
  const auto times = sunHoursOf("48.1,11.6 2026-06-21T08:00+02:00/2026-06-21T12:30+02:00");
  ASSERT_TRUE(times);
  EXPECT_EQ(times->begin, "2026-06-21T08:00+02:00");
  EXPECT_EQ(times->end, "2026-06-21T12:30+02:00");
  EXPECT_EQ(sunHoursOf("0,0 noon/")->begin, "noon"); // which the request's own check refuses, by its place
}

TEST(SunText, HoursNeedAPlaceAndADate) {
  for (const char* text :
       {"", "48.1,11.6", "48.1 2026-06-21", "48.1,11.6 2026-02-30", "48.1,11.6 2026-06-21T17:00Z", "2026-06-21"}) {
    EXPECT_FALSE(sunHoursOf(text)) << text;
  }
}

TEST(SunText, HoursKeepTheStepsOfARequestAndJoinItsViews) {
  SpecArguments flags;
  flags.sunHours = sunHoursOf("48.1,11.6 2026-06-21");
  const ResolvedSpec day = resolveSpec(R"({"sunHours": {"latitudeDegrees": 1, "longitudeDegrees": 2,
      "begin": "2026-06-21T00:00Z", "end": "2026-06-22T00:00Z", "stepMinutes": 5, "northDegrees": 20}})",
                                       flags);
  ASSERT_TRUE(day.spec) << day.spec.problems().front().detail;
  EXPECT_EQ(day.spec->sunHours->stepMinutes, 5);
  EXPECT_EQ(day.spec->sunHours->northDegrees, 20);
  EXPECT_EQ(day.spec->sunHours->latitudeDegrees, 48.1);
  EXPECT_EQ(day.spec->views, std::vector{View::sunHours});
  EXPECT_EQ(resolveSpec(R"({"views": ["color"]})", flags).spec->views, (std::vector{View::color, View::sunHours}));
  flags.views = {"sunHours", "depth"};
  EXPECT_EQ(resolveSpec("{}", flags).spec->views, (std::vector{View::sunHours, View::depth}));
}

} // namespace
} // namespace gnomon::cli
