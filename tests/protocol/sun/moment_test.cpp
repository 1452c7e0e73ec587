#include "protocol/sun/moment.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon {
namespace {

constexpr std::int64_t kHour = 3'600'000;

std::int64_t at(std::string_view text) {
  const auto moment = readMoment(text);
  EXPECT_TRUE(moment) << text;
  return moment ? moment->milliseconds : 0;
}

std::string refusal(std::string_view text) {
  const auto moment = readMoment(text);
  return moment ? "" : moment.problems().front().detail;
}

TEST(Moment, ReadsWhatTheStandardWrites) {
  EXPECT_EQ(at("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(at("1970-01-01t01:00:00.5+01:00"), 500);
  EXPECT_EQ(at("1969-12-31 23:59:59.123456789z"), -877);
  EXPECT_EQ(at("2026-06-21T17:00+02:00"), 1'782'054'000'000);
  EXPECT_EQ(at("2000-02-29T12:00:00-05:30") - at("2000-03-01T12:00:00-05:30"), -24 * kHour);
  EXPECT_EQ(at("1900-03-01T00:00:00Z") - at("1900-02-28T00:00:00Z"), 24 * kHour); // no leap year
  EXPECT_EQ(at("2026-06-21T00:00:00+12:00"), at("2026-06-20T00:00:00-12:00"));
}

TEST(Moment, RefusesWhatIsNoMoment) {
  for (const char* text : {"", "noon", "2026-06-21", "2026-6-21T17:00Z", "2026-06-21T17Z", "2026-06-21T17:00:0Z",
                           "2026-06-21T17:00:00.Z", "2026-06-21T17:00:00.1234567890Z", "-026-06-21T17:00:00Z"}) {
    EXPECT_EQ(refusal(text), "This is no date and time of RFC 3339.") << text;
  }
  for (const char* text :
       {"2026-13-01T00:00:00Z", "2026-00-01T00:00:00Z", "2023-02-29T00:00:00Z", "2026-04-31T00:00:00Z",
        "2026-04-30T24:00:00Z", "2026-04-30T23:60:00Z", "2026-04-30T23:59:61Z"}) {
    EXPECT_EQ(refusal(text), "There is no such day or time of day.") << text;
  }
  for (const char* text : {"2026-06-21T17:00:00X", "2026-06-21T17:00:00+0200", "2026-06-21T17:00:00+24:00",
                           "2026-06-21T17:00:00+02:60", "2026-06-21T17:00:00Z "}) {
    EXPECT_EQ(refusal(text), "The zone of this time can't be read.") << text;
  }
}

TEST(Moment, SaysWhatIsMissingOrOutOfBounds) {
  EXPECT_EQ(refusal("2026-06-21T17:00:00"), "A time needs its zone: Z for UTC, or how far the clock is ahead of it.");
  EXPECT_EQ(refusal("2016-12-31T23:59:60Z"), "Leap seconds are not supported; give the second before or after.");
  for (const char* text : {"1899-12-31T23:59:59Z", "2101-01-01T00:00:00Z"}) {
    const auto moment = readMoment(text);
    ASSERT_FALSE(moment);
    EXPECT_EQ(moment.problems().front().limit, "1900..2100");
  }
}

RC_GTEST_PROP(Moment, WhatIsWrittenIsReadAgain, ()) {
  const Moment moment{*rc::gen::inRange<std::int64_t>(-2'208'000'000'000, 4'133'000'000'000),
                      *rc::gen::inRange(-720, 841)};
  const auto again = readMoment(momentText(moment));
  RC_ASSERT(bool(again));
  RC_ASSERT(*again == moment);
}

TEST(Moment, TimePassesEvenlyByTheFirstClock) {
  const Moment from = *readMoment("2026-06-21T06:00:00+02:00"), to = *readMoment("2026-06-21T18:00:00Z");
  EXPECT_EQ(momentText(momentBetween(from, to, 0.5)), "2026-06-21T13:00:00+02:00");
  EXPECT_EQ(momentText(momentBetween(to, from, 0.25)), "2026-06-21T14:30:00Z");
}

} // namespace
} // namespace gnomon
