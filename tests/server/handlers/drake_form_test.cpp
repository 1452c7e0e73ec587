#include "server/handlers/drake_form.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

using Fields = std::map<std::string, std::string>;

const std::string kScene = "{}";

Fields good(const std::string& image = "color") {
  Sha256 hash;
  hash.add(kScene);
  Fields fields{
      {"scene", kScene},          {"scene_sha256", hash.hex()}, {"image_type", image}, {"width", "640"},
      {"height", "480"},          {"near", "0.010000"},         {"far", "10.000000"},  {"focal_x", "579.411255"},
      {"focal_y", "579.411255"},  {"fov_x", "1.009179"},        {"fov_y", "0.785398"}, {"center_x", "319.500000"},
      {"center_y", "239.500000"}, {"submit", "Render"}};
  if (image == "depth") fields.insert({{"min_depth", "0.1"}, {"max_depth", "5"}});
  return fields;
}

Result<DrakeForm> read(const Fields& fields) {
  std::vector<FormPart> parts;
  for (const auto& [name, value] : fields) parts.push_back({name, {}, "", value});
  return readDrakeForm(parts);
}

std::vector<std::string> wrongFields(const Fields& fields) {
  std::vector<std::string> names;
  const auto form = read(fields);
  if (form) return names;
  for (const Problem& problem : form.problems()) names.push_back(problem.pointer);
  return names;
}

TEST(DrakeForm, WhatDrakeSendsIsAFrame) {
  const Fields fields = good("depth");
  const auto form = read(fields);
  ASSERT_TRUE(form) << form.problems().front().pointer << form.problems().front().detail;
  EXPECT_EQ(form->scene, kScene);
  EXPECT_EQ(form->image, DrakeImage::depth);
  EXPECT_EQ(form->range->max, 5);
  const FrameSpec spec = drakeFrame(*form, drakeDefaults());
  EXPECT_EQ(spec.width, 640);
  EXPECT_EQ(spec.height, 480);
  EXPECT_EQ(spec.camera.intrinsics, (Intrinsics{579.411255, 579.411255, 319.5, 239.5, 0.01, 10}));
  EXPECT_EQ(std::get<std::string>(*spec.camera.node), "Camera Node");
  EXPECT_EQ(spec.views, std::vector{View::depth});
}

TEST(DrakeForm, ColorsAreDrawnAsTheOperatorSays) {
  const Fields fields = good();
  const auto form = read(fields);
  ASSERT_TRUE(form);
  FrameSpec colors;
  colors.exposure = 2;
  EXPECT_EQ(drakeFrame(*form, colors).exposure, 2);
  EXPECT_EQ(drakeFrame(*form, colors).views, std::vector{View::color});
  const Fields labels = good("label");
  EXPECT_EQ(drakeFrame(*read(labels), colors).exposure, 0) << "nothing that colors could depend on";
}

TEST(DrakeForm, EveryFieldIsNeeded) {
  for (const auto& [name, value] : good("depth")) {
    Fields fields = good("depth");
    fields.erase(name);
    EXPECT_EQ(wrongFields(fields), name == "submit" ? std::vector<std::string>{} : std::vector<std::string>{name})
        << name;
  }
}

TEST(DrakeForm, FieldsMustAgree) {
  for (const auto& [name, value] : Fields{{"fov_x", "1.0095"},
                                          {"fov_y", "0.7"},
                                          {"near", "10"},
                                          {"center_x", "639.5"},
                                          {"center_y", "-0.5"},
                                          {"min_depth", "5"},
                                          {"scene_sha256", std::string(64, 'a')}}) {
    Fields fields = good("depth");
    fields[name] = value;
    EXPECT_EQ(wrongFields(fields), std::vector{name}) << value;
  }
}

TEST(DrakeForm, NumbersAreWholeTextsWithinTheirBounds) {
  for (const char* value : {"", " 640", "640 ", "6e2x", "640.5", "0", "-1", "16385", "nan", "inf", "0x10", "1e999"}) {
    Fields fields = good();
    fields["width"] = value;
    EXPECT_EQ(wrongFields(fields), std::vector<std::string>{"width"}) << value;
  }
}

TEST(DrakeForm, AScenesBytesTellItsWork) {
  const Fields fields = good();
  const FrameSpec spec = drakeFrame(*read(fields), drakeDefaults());
  const auto work = [&](std::size_t bytes) {
    const FrameCost cost = frameCost(spec, likelyCounts(bytes));
    return cost[FramePart::survey] + cost[FramePart::shadow];
  };
  EXPECT_EQ(likelyCounts(10'000'000).triangles, 312'500u);
  EXPECT_GT(work(10'000'000), work(1'000) + 1e6) << "nanoseconds";
  EXPECT_EQ(likelyCounts(std::size_t{1} << 40).triangles, kLimits.maxTriangles);
}

TEST(DrakeSpec, BringsNothingThatTheFormBrings) {
  EXPECT_TRUE(readDrakeSpec(R"({"lights":[{"direction":[0,0,-1]}],"shadow":{"technique":"rayTraced"}})"));
  for (const auto& [json, pointer] : std::map<std::string, std::string>{{R"({"width":64})", "/width"},
                                                                        {R"({"camera":{"fit":true}})", "/camera"},
                                                                        {R"({"views":["depth"]})", "/views"},
                                                                        {R"({"output":{"format":"exr"}})", "/output"},
                                                                        {R"({"light":[]})", "/light"}}) {
    const auto spec = readDrakeSpec(json);
    ASSERT_FALSE(spec) << json;
    EXPECT_EQ(spec.problems().front().pointer, pointer);
  }
}

} // namespace
} // namespace gnomon
