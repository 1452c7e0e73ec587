#include "protocol/base/nearest_name.h"

#include <gtest/gtest.h>
#include <vector>

#include "protocol/json/json_codec.h"
#include "protocol/json/query_codec.h"

namespace gnomon {
namespace {

const std::vector<std::string> kNames{"width", "height", "camera"};

TEST(NearestName, IsTheOneWithTheFewestEdits) {
  EXPECT_EQ(nearestName("widht", kNames), "width");
  EXPECT_EQ(nearestName("Camera", kNames), "camera");
  EXPECT_EQ(nearestName("depth", kNames), "");
  EXPECT_EQ(nearestName("camra", kNames, 0), "");
}

TEST(NearestName, EndsASentence) {
  EXPECT_EQ(suggestion("widht", kNames), "; did you mean width?");
  EXPECT_EQ(suggestion("lens", kNames), ".");
}

TEST(NearestName, IsToldOfFieldsAndViews) {
  const auto detail = [](const Result<FrameSpec>& refused) { return refused.problems().front().detail; };
  EXPECT_EQ(detail(decodeFrameSpec(R"({"widht": 3})")), "There is no field of this name; did you mean width?");
  EXPECT_EQ(detail(decodeFrameSpec(R"({"shadow": {"filtr": {}}})")),
            "There is no field of this name; did you mean filter?");
  EXPECT_EQ(detail(decodeFrameSpec(R"({"views": ["dept"]})")),
            "This is not one of the possible values; did you mean depth?");
  EXPECT_EQ(detail(decodeFrameQuery({{"view", "shadows"}})),
            "This is not one of the possible values; did you mean shadow?");
  EXPECT_EQ(detail(decodeFrameQuery({{"lights[0].intensty", "3"}})),
            "There is no field of this name; did you mean intensity?");
  EXPECT_EQ(detail(decodeFrameSpec(R"({"xyz": 3})")), "There is no field of this name.");
}

} // namespace
} // namespace gnomon
