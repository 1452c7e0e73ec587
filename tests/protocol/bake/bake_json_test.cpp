#include "protocol/bake/bake_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

FrameSpec specOf(const char* json) {
  const auto spec = decodeFrameSpec(json);
  EXPECT_TRUE(spec) << spec.problems().front().detail;
  return *spec;
}

TEST(BakeJson, WhatOnlyThePictureDependsOnDoesNotChangeTheKey) {
  const std::string key = bakeKey("scene", {});
  EXPECT_EQ(key.size(), 64u);
  for (const char* same : {R"({"width": 64})", R"({"camera": {"orbit": {"azimuthDegrees": 3}}})",
                           R"({"exposure": 1, "views": ["depth"], "device": "cpu"})"}) {
    EXPECT_EQ(bakeKey("scene", specOf(same)), key) << same;
  }
  for (const char* other :
       {R"({"shadow": {"lightMap": {"size": 64}}})", R"({"lights": [{"sun": {}}]})", R"({"scene": 1})",
        R"({"nodes": [{"node": 1, "visible": false}]})", R"({"animation": {"index": 0, "timeSeconds": 1}})"}) {
    EXPECT_NE(bakeKey("scene", specOf(other)), key) << other;
  }
  EXPECT_NE(bakeKey("another", {}), key);
}

TEST(BakeJson, AReportReadsBackAndWhatIsNoneIsNone) {
  BakeReport report;
  report.key = "k";
  report.lights.push_back({2, {.reused = true, .width = 64, .bytes = 8}});
  const auto read = readBakeReport(toJson(report).dump());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->lights[0].light, 2);
  EXPECT_EQ(read->lights[0].lightMap.width, 64);
  for (const char* none : {"", "{", "[]", "{}", R"({"lights": []})"}) EXPECT_FALSE(readBakeReport(none)) << none;
}

} // namespace
} // namespace gnomon
