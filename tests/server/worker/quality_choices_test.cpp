#include "server/worker/quality_choices.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(QualityChoices, RemembersTheLastThatWasUsed) {
  QualityChoices choices;
  QualityReport report;
  report.chosen = 3;
  EXPECT_FALSE(choices.find("a"));
  choices.keep("a", report);
  choices.keep("b", {});
  ASSERT_TRUE(choices.find("a"));
  EXPECT_EQ(choices.find("a")->chosen, 3u);
  for (int i = 0; i < 1023; ++i) choices.keep(std::to_string(i), {});
  EXPECT_TRUE(choices.find("a")) << "used after b";
  EXPECT_FALSE(choices.find("b"));
}

} // namespace
} // namespace gnomon
