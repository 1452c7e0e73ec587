#include "clients/cli/problem_text.h"

#include <gtest/gtest.h>

#include "clients/cli/output_files.h"
#include "clients/cli/summary_text.h"

namespace gnomon::cli {
namespace {

TEST(ProblemLine, SaysWhereWhatAndWhich) {
  EXPECT_EQ(problemLine({ProblemCode::invalidValue, "/width", "too wide", "1..8192", "9000"}),
            "/width: too wide; allowed: 1..8192; got: 9000");
  EXPECT_EQ(problemLine({ProblemCode::malformed, "", "not JSON", "", ""}), "not JSON");
}

TEST(ProblemLine, NamesTheFlagThatSetThePlaceOrWhatHoldsIt) {
  const FlagOrigins origins{{"/camera/orbit", "--orbit"}, {"/width", "--width"}};
  EXPECT_EQ(problemLine({ProblemCode::invalidValue, "/camera/orbit/distance", "no", "", ""}, origins),
            "--orbit (/camera/orbit/distance): no");
  EXPECT_EQ(problemLine({ProblemCode::invalidValue, "/camera", "no", "", ""}, origins), "/camera: no");
  EXPECT_EQ(problemLine({ProblemCode::invalidValue, "/widths", "no", "", ""}, origins), "/widths: no");
}

TEST(ProblemLine, CantSteerTheTerminal) {
  EXPECT_EQ(problemLine({ProblemCode::invalidScene, "", "a\x1b[2Jb\nc\x7f", "", ""}), "a?[2Jb?c?");
}

TEST(OutputFiles, FormatIsTheSuffix) {
  EXPECT_EQ(formatOf("a/frame.png"), "png");
  EXPECT_EQ(formatOf("frame.b.exr"), "exr");
  for (const char* name : {"-", "frame", "frame.jpg", "frame.PNG", ".png", "png"}) EXPECT_FALSE(formatOf(name)) << name;
}

TEST(OutputFiles, SeveralPicturesGetTheirViewsNames) {
  EXPECT_EQ(pictureFile("a.b/frame.png", "depth", 1), "a.b/frame.png");
  EXPECT_EQ(pictureFile("a.b/frame.png", "depth", 2), "a.b/frame.depth.png");
}

TEST(OutputFiles, StandardOutputTakesOnePicture) {
  const auto written = writePictures({{"color", {1}}, {"depth", {2}}}, "-");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.problems().front().actual, "2");
}

TEST(SummaryText, IsATree) {
  SceneSummary summary;
  summary.bytes = 2'621'440;
  summary.scenes = 1;
  summary.triangles = 1'234'567;
  summary.cameras = {{4, "Main \x1b[1m", "perspective"}};
  summary.warnings = {"animation 0 is not played"};
  const std::string text = summaryText("box.glb", summary);
  EXPECT_TRUE(text.starts_with("box.glb\n├─ size  2.5 MiB, 0 bytes loaded\n")) << text;
  EXPECT_NE(text.find("│  ├─ 1 234 567 triangles, 0 vertices\n"), std::string::npos) << text;
  EXPECT_NE(text.find("├─ cameras  1\n│  └─ node 4 \"Main ?[1m\", perspective\n"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("└─ warnings  1\n   └─ animation 0 is not played\n")) << text;
}

} // namespace
} // namespace gnomon::cli
