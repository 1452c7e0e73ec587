#include "clients/cli/files/output_names.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon::cli {
namespace {

TEST(FilledIn, PutsValuesInPlaceAndLeavesTheView) {
  EXPECT_EQ(*filledIn("{a}/{b}-{a}.{view}.png", {{"a", "x"}, {"b", "y"}}), "x/y-x.{view}.png");
  EXPECT_EQ(*filledIn("{} {A} { {1}", {}), "{} {A} { {1}");
  EXPECT_FALSE(filledIn("{frame}.png", {{"scene", "x"}}));
}

TEST(FilledIn, AValueNeverLeadsToAnotherFolder) {
  EXPECT_EQ(*filledIn("out/{a}.png", {{"a", "../../etc/passwd"}}), "out/.._.._etc_passwd.png");
  EXPECT_EQ(*filledIn("out/{a}/x.png", {{"a", ".."}}), "out/_/x.png");
  rc::check([](const std::string& value) {
    RC_ASSERT(filledIn("{a}", {{"a", value}})->find('/') == std::string::npos);
    RC_ASSERT(*filledIn("{a}", {{"a", value}}) != "..");
  });
}

TEST(BatchItems, AreEveryCameraOfEverySceneSceneByScene) {
  const auto items = batchItems({{"d/a.glb", "-"}, {"x", "y"}, "{scene}-{camera}.png", "{scene}{camera}.json"});
  ASSERT_TRUE(items);
  ASSERT_EQ(items->size(), 4u);
  EXPECT_EQ((*items)[1].output, "a-y.png");
  EXPECT_EQ((*items)[2].output, "stdin-x.png");
  EXPECT_EQ((*items)[3].report, "stdiny.json");
}

TEST(BatchItems, WithoutACameraTheNameIsDefault) {
  EXPECT_EQ(batchItems({{"a.glb"}, {}, "{camera}.png", ""})->front().output, "default.png");
}

TEST(BatchItems, TwoPicturesAreNeverOneFile) {
  EXPECT_FALSE(batchItems({{"a.glb", "b.glb"}, {}, "x.png", ""}));
  EXPECT_FALSE(batchItems({{"1/a.glb", "2/a.glb"}, {}, "{scene}.png", ""}));
  EXPECT_FALSE(batchItems({{"a.glb"}, {"x/y", "x_y"}, "{camera}.png", ""}));
  EXPECT_FALSE(batchItems({{"a.glb", "b.glb"}, {}, "-", ""}));
  EXPECT_FALSE(batchItems({{"a.glb", "b.glb"}, {}, "{scene}.png", "r.json"}));
}

TEST(FrameNumber, Sorts) {
  EXPECT_EQ(frameNumber(7), "00007");
  EXPECT_EQ(frameNumber(123456), "123456");
}

} // namespace
} // namespace gnomon::cli
