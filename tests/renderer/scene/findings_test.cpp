#include "renderer/scene/findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

using ::testing::ElementsAre;

const Repair kRounded{"A number is beyond its limit by rounding", "it is brought to the limit"};
const Repair kTwice{"An index is listed twice", "it counts once"};

TEST(Findings, OneWarningForEachKindOfRepairCountsThePlacesAndNamesTheFirst) {
  Findings findings;
  findings.warn("A texture is left out.");
  findings.repair(kRounded, "/materials/0");
  findings.repair(kTwice, "/scenes/0");
  findings.repair(kRounded, "/materials/7");
  EXPECT_FALSE(findings.refused());
  EXPECT_THAT(
      findings.takeWarnings(),
      ElementsAre("A number is beyond its limit by rounding; it is brought to the limit (2 places, the first is "
                  "/materials/0).",
                  "An index is listed twice; it counts once (/scenes/0).", "A texture is left out."));
}

TEST(Findings, WhatOthersRepairedCountsAsIfFoundHere) {
  Findings findings;
  findings.repair(kRounded, "/materials/0");
  Findings other;
  other.repair(kRounded, "/materials/1");
  other.repair(kRounded, "/materials/2");
  findings.take(std::move(other));
  EXPECT_THAT(findings.takeWarnings(),
              ElementsAre("A number is beyond its limit by rounding; it is brought to the limit "
                          "(3 places, the first is /materials/0)."));
}

TEST(Findings, AFileThatHasToConformIsRefusedWhereItWouldBeRepaired) {
  Findings findings(Conformance::strict);
  findings.repair(kRounded, "/materials/0");
  EXPECT_TRUE(findings.violated());
  EXPECT_FALSE(findings.refused()) << "the rest of the file is looked at, too";
  const Problems problems = findings.takeProblems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, ProblemCode::invalidScene);
  EXPECT_EQ(problems[0].pointer, "/materials/0");
  EXPECT_EQ(problems[0].detail,
            "A number is beyond its limit by rounding. Without `strict`, it is brought to the limit.");
}

TEST(Findings, APartThatIsLeftOutTakesItsProblemsAlong) {
  Findings part;
  part.invalid("/cameras/0/yfov", "The field of view is too wide.", "< 180", "200");
  part.repair(kRounded, "/cameras/0/znear");
  Findings findings;
  EXPECT_EQ(findings.leaveOut(std::move(part), "the camera is left out"),
            "The field of view is too wide. (/cameras/0/yfov)");
  EXPECT_EQ(findings.leaveOut(Findings(), "nothing is left out"), "");
  EXPECT_FALSE(findings.refused());
  EXPECT_THAT(findings.takeWarnings(),
              ElementsAre("A number is beyond its limit by rounding; it is brought to the limit (/cameras/0/znear).",
                          "The field of view is too wide; the camera is left out (/cameras/0/yfov: 200)."));
}

TEST(Findings, LimitsRefuseThePartAndTheFile) {
  Findings part;
  part.tooLarge("/animations/0", "There are too many keyframes.", "8", "9");
  Findings findings;
  findings.leaveOut(std::move(part), "the channel is left out");
  EXPECT_TRUE(findings.refused());
}

} // namespace
} // namespace gnomon
