#include "clients/cli/terminal/messages.h"

#include <gtest/gtest.h>
#include <sstream>
#include <vector>

#include "clients/cli/files/file_io.h"
#include "clients/cli/files/output_names.h"
#include "clients/cli/terminal/result_text.h"

namespace gnomon::cli {
namespace {

TEST(ProblemLine, SaysWhereWhatAndWhich) {
  EXPECT_EQ(problemLine({ProblemCode::invalidValue, "/width", "Too wide.", "1..8192", "9000"}),
            "/width: Too wide. Allowed: 1..8192. Got: 9000.");
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
  EXPECT_EQ(formatOf("frame.tif"), "tiff");
  EXPECT_EQ(formatOf("frame.tiff"), "tiff");
  EXPECT_EQ(formatOf("frame.jpg"), "jpeg");
  EXPECT_EQ(formatOf("frame.jpeg"), "jpeg");
  for (const char* name : {"-", "frame", "frame.gif", "frame.PNG", ".png", "png"}) EXPECT_FALSE(formatOf(name)) << name;
  EXPECT_EQ(suffixList(), ".png .exr .npy .npz .tiff .tif .jpg .jpeg .webp");
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
  summary.memoryBytes = 3072;
  summary.memory.vertices = 2048;
  summary.memory.images = 1024;
  summary.boundsMin = {-1, 0, 2};
  summary.boundsMax = {1, 0.5, 5};
  summary.scenes = 1;
  summary.triangles = 1'234'567;
  summary.vertices = 1;
  summary.nodes = 2;
  summary.meshes = 1;
  summary.instances = 3;
  summary.materials = 1;
  summary.skins = 1;
  summary.joints = 19;
  summary.cameras = {{4, "Main \x1b[1m", "perspective"}};
  summary.extensionsUsed = {"KHR_a", "KHR_b"};
  summary.extensionsIgnored = {"KHR_b"};
  summary.warnings = {"points are not drawn"};
  EXPECT_EQ(summaryText("box.glb", summary),
            "box.glb\n"
            "├─ file  2.5 MiB\n"
            "├─ memory  3.0 KiB\n"
            "│  ├─ vertices  2.0 KiB\n"
            "│  └─ images  1.0 KiB\n"
            "├─ bounds  2 x 0.5 x 3 m\n"
            "│  ├─ from -1, 0, 2\n"
            "│  └─ to   1, 0.5, 5\n"
            "├─ geometry  1 234 567 triangles\n"
            "│  ├─ 2 nodes\n"
            "│  ├─ 1 mesh, placed as 3 instances of primitives\n"
            "│  └─ 1 vertex\n"
            "├─ appearance  1 material\n"
            "│  └─ 0 textures of 0 images\n"
            "├─ motion\n"
            "│  └─ 1 skin of 19 joints\n"
            "├─ cameras  1\n"
            "│  └─ 0: node 4 \"Main ?[1m\", perspective\n"
            "├─ extensions  2\n"
            "│  ├─ KHR_a\n"
            "│  └─ KHR_b  (ignored)\n"
            "└─ drawn differently  1\n"
            "   └─ points are not drawn\n");
}

TEST(SummaryText, TellsWhichOfSeveralScenesItIsAbout) {
  SceneSummary summary;
  summary.scenes = 3;
  summary.defaultScene = 1;
  EXPECT_NE(summaryText("box.glb", summary).find("├─ scenes  3, shown is the default: scene 1\n"), std::string::npos);
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(EvaluationTable, TellsTimesAsMultiplesOfTheFirstAndErrorsInPercent) {
  EvaluationReport report;
  EvaluationRow hard;
  hard.name = "härt";
  hard.milliseconds = 20;
  hard.metrics.emplace();
  hard.metrics->misclassified = 0.0125;
  hard.metrics->falseShadow = 0.01;
  hard.metrics->falseLit = 0.0025;
  hard.metrics->edgeDisplacement = EdgeDisplacement{0.5, 0, 0, 0};
  hard.pareto = true;
  EvaluationRow slow = hard;
  slow.name = "slow";
  slow.milliseconds = 50;
  slow.metrics->edgeDisplacement.reset();
  slow.pareto = false;
  EvaluationRow refused;
  refused.name = "refused";
  refused.problems = {{"invalidValue", "/shadow", "No\x1b[31m such.", std::nullopt, std::nullopt}};
  report.rows = {hard, slow, refused};
  report.reference.frames = 1;
  const auto lines = linesOf(evaluationTable(report));
  ASSERT_GE(lines.size(), 6u);
  EXPECT_EQ(lines[0], "           ms     x  wrong %  false shadow %  false lit %  edge px");
  EXPECT_EQ(lines[1], "härt     20.0  1.00   1.2500          1.0000       0.2500     0.50  *");
  EXPECT_EQ(lines[2], "slow     50.0  2.50   1.2500          1.0000       0.2500        -");
  report.rankedBy = RankedError::rms;
  report.rows[0].metrics->rms = 0.0123456;
  const auto ofShares = linesOf(evaluationTable(report));
  EXPECT_EQ(ofShares[0], "           ms     x      rms  false shadow %  false lit %  edge px");
  EXPECT_EQ(ofShares[1], "härt     20.0  1.00  0.01235          1.0000       0.2500     0.50  *");
  EXPECT_EQ(lines[3], "refused  /shadow: No?[31m such.");
  EXPECT_TRUE(lines[5].starts_with("Held against 1 traced frame (")) << lines[5];
}

} // namespace
} // namespace gnomon::cli
