#include <algorithm>
#include <gtest/gtest.h>

#include "protocol/sequence/sequence.h"
#include "protocol/spec/traits.h"
#include "tests/protocol/found_problems.h"

namespace gnomon {
namespace {

Sequence sequenceOf(const Json& request) {
  auto sequence = decodeSequence(request.dump());
  if (!sequence) ADD_FAILURE() << sequence.problems().front().pointer << " " << sequence.problems().front().detail;
  return *std::move(sequence);
}

/// The problem at a place; empty where there is none.
std::string problemAt(const Json& request, const std::string& pointer) {
  const auto sequence = decodeSequence(request.dump());
  if (sequence) return {};
  for (const Problem& problem : sequence.problems()) {
    if (problem.pointer == pointer) return problem.detail;
  }
  ADD_FAILURE() << "The first problem is at " << sequence.problems().front().pointer;
  return {};
}

Json keyed(Json first, Json second, int count = 5) {
  return {{"keys", {std::move(first), std::move(second)}}, {"count", count}};
}

TEST(SequenceJson, EveryPatchIsAFrameOverTheSpec) {
  const Sequence sequence = sequenceOf({{"spec", {{"width", 320}, {"exposure", 1}}},
                                        {"frames", {{{"exposure", 2}}, Json::object(), {{"exposure", nullptr}}}},
                                        {"stable", false}});
  ASSERT_EQ(sequence.count, 3);
  EXPECT_EQ(frameSpec(sequence, 0, {}).exposure, 2);
  EXPECT_EQ(frameSpec(sequence, 1, {}).exposure, 1);
  EXPECT_EQ(frameSpec(sequence, 2, {}).exposure, 0);
  EXPECT_EQ(frameSpec(sequence, 2, {}).width, 320);
  EXPECT_EQ(framePlace(sequence, 2), "/frames/2");
}

TEST(SequenceJson, KeysAreInterpolatedAndExactAtBothEnds) {
  Json request = keyed({{"exposure", 0.1}}, {{"exposure", 0.7}}, 4);
  request["keys"].push_back({{"exposure", -3.3}});
  request["count"] = 5;
  request["stable"] = false;
  const Sequence sequence = sequenceOf(request);
  EXPECT_EQ(frameSpec(sequence, 0, {}).exposure, 0.1);
  EXPECT_DOUBLE_EQ(frameSpec(sequence, 1, {}).exposure, 0.4);
  EXPECT_EQ(frameSpec(sequence, 2, {}).exposure, 0.7);
  EXPECT_EQ(frameSpec(sequence, 4, {}).exposure, -3.3);
  EXPECT_EQ(framePlace(sequence, 1), "/keys/0");
  EXPECT_EQ(framePlace(sequence, 2), "/keys/1");
}

TEST(SequenceJson, TheSpecsOwnValueIsTheOneOfAKeyWithoutIt) {
  const Sequence sequence =
      sequenceOf({{"spec", {{"exposure", 1}}}, {"keys", {Json::object(), {{"exposure", 3}}}}, {"count", 3}});
  EXPECT_EQ(frameSpec(sequence, 1, {}).exposure, 2);
}

TEST(SequenceJson, WhatCanNotBeInterpolatedIsAProblemAtItsPlace) {
  EXPECT_NE(problemAt(keyed({{"toneMapping", "aces"}}, {{"toneMapping", "none"}}), "/keys/1/toneMapping"), "");
  EXPECT_NE(problemAt(keyed(Json::object(), {{"exposure", 1}}), "/keys/1/exposure"), "");
  EXPECT_NE(problemAt(keyed({{"views", {"color"}}}, {{"views", {"color", "depth"}}}), "/keys/1/views"), "");
  EXPECT_NE(problemAt(keyed({{"camera", {{"eye", {1, 2, 3}}, {"target", {0, 0, 0}}}}},
                            {{"camera", {{"eye", {1, 2, 3}}, {"target", "here"}}}}),
                      "/keys/1/camera/target"),
            "");
}

TEST(SequenceJson, ProblemsOfAFrameStandAtTheFrame) {
  EXPECT_NE(problemAt({{"frames", {Json::object(), {{"exposure", "bright"}}}}}, "/frames/1/exposure"), "");
  EXPECT_NE(problemAt({{"frames", {{{"shadow", {{"cascades", 4}}}}}}}, "/frames/0/shadow/cascades"), "");
  EXPECT_NE(problemAt({{"spec", {{"width", 0}}}, {"frames", {Json::object()}}}, "/spec/width"), "");
}

TEST(SequenceJson, AProblemOfTheSpecIsToldOnce) {
  Json request{{"spec", {{"width", 0}}}, {"frames", Json::array()}};
  for (int i = 0; i < 20; ++i) request["frames"].push_back(Json::object());
  const auto sequence = decodeSequence(request.dump());
  ASSERT_FALSE(sequence);
  EXPECT_EQ(sequence.problems().size(), 1u);
}

TEST(SequenceJson, NoMoreProblemsAreToldThanAnyReplyTells) {
  Json request{{"frames", Json::array()}};
  for (int i = 0; i < 500; ++i) request["frames"].push_back({{"exposure", "bright"}});
  const auto sequence = decodeSequence(request.dump());
  ASSERT_FALSE(sequence);
  EXPECT_LE(sequence.problems().size(), ProblemList::kMax + 1);
}

TEST(SequenceJson, MembersThatContradictEachOtherAreRefused) {
  const Json frames = Json::array({Json::object(), Json::object()});
  EXPECT_NE(problemAt({{"frames", frames}, {"count", 2}}, "/count"), "");
  EXPECT_NE(
      problemAt({{"frames", frames}, {"stable", false}, {"carried", {{"depthRanges", Json::array()}}}}, "/carried"),
      "");
  EXPECT_NE(problemAt({{"frames", {{{"quality", {{"maxError", 0.1}}}}}}}, "/frames/0/quality"), "");
}

TEST(SequenceJson, WhatIsCarriedIsInputLikeAllElse) {
  const auto with = [](const Json& ranges) {
    return Json{{"frames", {Json::object(), Json::object()}}, {"first", 1}, {"carried", {{"depthRanges", ranges}}}};
  };
  EXPECT_TRUE(decodeSequence(with(Json::array()).dump()));
  EXPECT_NE(problemAt(with({{{"light", -1}, {"near", 1}, {"far", 2}}}), "/carried/depthRanges/0/light"), "");
  EXPECT_NE(problemAt(with({{{"light", 0}, {"near", 1}, {"far", "far"}}}), "/carried/depthRanges/0/far"), "");
  EXPECT_NE(problemAt(with({{{"light", 0}, {"near", 1}, {"far", 2}}, {{"light", 0}, {"near", 1}, {"far", 2}}}),
                      "/carried/depthRanges/1/light"),
            "");
}

TEST(SequenceJson, EachFrameFromTheFirstOnIsShown) {
  std::vector<double> exposures;
  ASSERT_TRUE(decodeSequence(R"({"frames": [{}, {"exposure": 1}, {"exposure": 2}], "first": 1, "stable": false})",
                             [&](const FrameSpec& spec) { exposures.push_back(spec.exposure); }));
  EXPECT_EQ(exposures, (std::vector<double>{1, 2}));
}

TEST(Carry, AStableFrameTakesTheRangeOfTheOneBefore) {
  const Sequence sequence = sequenceOf({{"frames", {Json::object(), Json::object()}}});
  const FrameSpec first = frameSpec(sequence, 0, {});
  EXPECT_EQ(first.shadow.stabilization, Stabilization::projectionSnapping);
  ASSERT_TRUE(first.shadow.depthRange.previous); // else it would be fitted otherwise than all others
  const FrameSpec second = frameSpec(sequence, 1, {{{0, 2, 30}}});
  EXPECT_EQ(second.shadow.depthRange.previous, (PreviousRange{2, 30}));
}

TEST(Carry, WhatTheSpecSaysItselfStays) {
  const Sequence sequence = sequenceOf(
      {{"spec",
        {{"shadow", {{"stabilization", "none"}, {"depthRange", {{"mode", "manual"}, {"min", 0}, {"max", 9}}}}}}},
       {"frames", {Json::object()}}});
  const FrameSpec spec = frameSpec(sequence, 0, {{{0, 2, 30}}});
  EXPECT_EQ(spec.shadow.stabilization, Stabilization::none);
  EXPECT_FALSE(spec.shadow.depthRange.previous);
}

TEST(Carry, ALightWithAShadowOfItsOwnHasItsOwnRange) {
  const Json sun{{"type", "directional"}, {"direction", {0, -1, 0.5}}};
  Json own = sun;
  own["shadow"] = {{"cascadeCount", 2}};
  const Sequence sequence = sequenceOf({{"spec", {{"lights", {own, sun}}}}, {"frames", {Json::object()}}});
  const FrameSpec spec = frameSpec(sequence, 0, {{{0, 1, 10}, {1, 2, 20}}});
  EXPECT_EQ((*spec.lights)[0].shadow->depthRange.previous, (PreviousRange{1, 10}));
  EXPECT_EQ((*spec.lights)[0].shadow->stabilization, Stabilization::projectionSnapping);
  EXPECT_EQ(spec.shadow.depthRange.previous, (PreviousRange{2, 20}));
}

TEST(Carry, AFrameWithoutARangePassesTheOneBeforeOn) {
  FrameReport report;
  report.lights = {{.light = 1, .depthRange = PreviousRange{3, 4}}, {.light = 2}};
  const Carried after = carriedAfter({{{0, 1, 2}, {1, 1, 2}}}, carriedOf(report));
  EXPECT_EQ(after, (Carried{{{0, 1, 2}, {1, 3, 4}}}));
  EXPECT_EQ(*decodeCarried(jsonText(toJson(after))), after);
}

TEST(VideoFrames, AFrameHasOneViewAsItIsSeen) {
  FrameSpec spec;
  spec.views = {View::depth, View::color};
  spec.output.format = ImageFormat::exr;
  spec.output.pngBits = 16;
  const FrameSpec frame = videoFrame(spec);
  EXPECT_EQ(frame.views, std::vector<View>{View::depth});
  EXPECT_EQ(pixelTypeOf(View::depth, frame.output), PixelType::bytes);
}

std::optional<Problem> sizeProblem(const Json& request) {
  FrameSizes sizes;
  const auto sequence = decodeSequence(request.dump(), [&](const FrameSpec& spec) { sizes.see(spec); });
  EXPECT_TRUE(sequence);
  return sizes.problem(*sequence);
}

TEST(VideoFrames, TheFirstFrameOfAnotherSizeIsNamed) {
  Json request = {{"spec", {{"width", 64}, {"height", 48}}}, {"stable", false}};
  request["frames"] = {Json::object(), {{"exposure", 1}}, {{"width", 64}}};
  EXPECT_FALSE(sizeProblem(request));
  request["frames"].push_back({{"height", 49}});
  request["frames"].push_back({{"width", 65}});
  const auto problem = sizeProblem(request);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->pointer, "/frames/3/height");
  EXPECT_EQ(problem->limit, "64x48");
  EXPECT_EQ(problem->actual, "64x49");
  request["first"] = 3;
  EXPECT_EQ(sizeProblem(request)->pointer, "/frames/4/width") << "what comes before the first does not count";
  request["first"] = 4;
  EXPECT_FALSE(sizeProblem(request));
}

} // namespace
} // namespace gnomon
