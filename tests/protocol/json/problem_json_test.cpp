#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/bake/bake.h"
#include "protocol/job/job.h"
#include "protocol/json/json_codec.h"
#include "tests/protocol/schema_check.h"

namespace gnomon {
namespace {

TEST(ProblemJson, TellsOneProblem) {
  const Json json = problemJson({{.code = ProblemCode::invalidValue,
                                  .pointer = "/width",
                                  .detail = "This is out of range.",
                                  .limit = "1..8192",
                                  .actual = "0"}},
                                400, "request-1");
  EXPECT_EQ(json.dump(),
            R"({"type":"/problems/invalidValue","title":"Invalid Value","status":400,)"
            R"("detail":"This is out of range.","instance":"request-1","problems":[{"code":"invalidValue",)"
            R"("pointer":"/width","detail":"This is out of range.","limit":"1..8192","actual":"0"}]})");
}

TEST(ProblemJson, TellsSeveralAndLeavesOutWhatIsEmpty) {
  const Json json =
      problemJson({{.code = ProblemCode::busy, .detail = "Full."}, {.code = ProblemCode::tooLarge}}, 429, "");
  EXPECT_EQ(json["type"], "/problems/busy");
  EXPECT_EQ(json["problems"].size(), 2u);
  EXPECT_FALSE(json.contains("instance"));
  EXPECT_FALSE(json["problems"][0].contains("limit") || json["problems"][0].contains("actual"));
  EXPECT_EQ(json["problems"][1]["code"], "tooLarge");
  EXPECT_NE(json["detail"].get<std::string>().find("2 problems"), std::string::npos);
}

TEST(ProblemJson, AnyBytesCanBeWritten) {
  const Json json =
      problemJson({{.pointer = "\xFF", .detail = "\x80", .limit = "\xC3", .actual = "\xED\xA0\x80"}}, 500, "\xFE");
  EXPECT_NO_THROW(json.dump());
  EXPECT_EQ(json["problems"][0]["actual"], "???");
}

TEST(ProblemJson, EveryCodeHasItsOwnNameAndTitle) {
  std::set<std::string_view> names;
  std::set<std::string_view> titles;
  for (int code = 0; code <= static_cast<int>(ProblemCode::internal); ++code) {
    names.insert(problemName(static_cast<ProblemCode>(code)));
    titles.insert(problemTitle(static_cast<ProblemCode>(code)));
  }
  EXPECT_EQ(names.size(), 21u);
  EXPECT_EQ(titles.size(), 21u);
  EXPECT_EQ(problemName(ProblemCode::hashMismatch), "hashMismatch");
}

TEST(ProblemJson, CountsTheProblemsThatThereAre) {
  const auto detailOf = [](int count) {
    ProblemList problems;
    for (int i = 0; i < count; ++i) problems.add(invalidValue("/a", "Wrong."));
    return problemJson(std::move(problems).take(), 400, "")["detail"].get<std::string>();
  };
  EXPECT_EQ(detailOf(1), "Wrong.");
  EXPECT_EQ(detailOf(32), "There are 32 problems, the first at \"/a\": Wrong.");
  EXPECT_EQ(detailOf(33), "There are more than 32 problems, the first at \"/a\": Wrong.");
  EXPECT_EQ(detailOf(5'000), "There are more than 32 problems, the first at \"/a\": Wrong.");
}

TEST(FrameSpecJson, OfNothingHasTheDefaultsAndOfBlanksIsMalformed) {
  EXPECT_TRUE(decodeFrameSpec(""));
  for (const char* text : {" ", "   ", "\r\n\t"}) {
    const auto spec = decodeFrameSpec(text);
    ASSERT_FALSE(spec);
    EXPECT_EQ(spec.problems().front().code, ProblemCode::malformed);
  }
}

TEST(ProblemJson, FitsItsSchema) {
  const Json schema = problemSchema();
  const Json json = problemJson({{.code = ProblemCode::busy, .detail = "Full.", .limit = "3"}}, 429, "id");
  EXPECT_EQ(checkAgainstSchema(json, schema, schema), "ok");
  EXPECT_EQ(checkAgainstSchema(Json::object(), schema, schema), "");
}

TEST(QualityJson, ComesBackAsItWas) {
  QualityReport report;
  report.met = true;
  report.chosen = 1;
  report.tried.resize(2);
  report.tried[1].settings = "shadowMap hard 4 x 1024";
  report.tried[1].shadow.cascadeCount = 2;
  report.tried[1].milliseconds = 1.5;
  const std::string text = jsonText(toJson(report));
  const auto read = readQualityReport(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(jsonText(toJson(*read)), text);
}

TEST(QualityJson, WhatIsNoReportIsNone) {
  QualityReport report;
  report.tried.resize(2);
  report.chosen = 2;
  EXPECT_FALSE(readQualityReport(jsonText(toJson(report)))) << "the chosen one has to be among those tried";
  for (const char* text :
       {"", "{", "[]", R"({"met": 1})", R"({"met": true, "tried": [{"shadow": {"cascadeCount": -5}}]})"}) {
    EXPECT_FALSE(readQualityReport(text)) << text;
  }
}

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
  // The studio instead of the glTF's own light, whose sun would be a light; which one is seen in the picture alone.
  const std::string studio = bakeKey("scene", specOf(R"({"environment": {"studio": "even"}})"));
  EXPECT_NE(studio, key);
  EXPECT_EQ(bakeKey("scene", specOf(R"({"environment": {"studio": "lamps"}})")), studio);
  EXPECT_NE(bakeKey("scene", specOf(R"({"environment": {"light": 0}})")), key);
}

TEST(BakeKey, RaysToTheEnvironmentChangeItOnlyWhereTheyAreAskedFor) {
  const std::string key = bakeKey("scene", {});
  for (
      const char* same :
      {R"({"environment": {"samples": 8}})", R"({"ambient": {"intensity": 1}})",
       R"({"environment": {"shadows": "none", "samples": 8, "background": "blurred"}, "ambient": {"intensity": 1}})"}) {
    EXPECT_EQ(bakeKey("scene", specOf(same)), key) << same;
  }
  const char* traced = R"({"environment": {"shadows": "rays"}})";
  EXPECT_NE(bakeKey("scene", specOf(traced)), key);
  for (const char* other : {R"({"environment": {"shadows": "rays", "samples": 8}})",
                            R"({"environment": {"shadows": "rays"}, "ambient": {"intensity": 1}})"}) {
    EXPECT_NE(bakeKey("scene", specOf(other)), bakeKey("scene", specOf(traced))) << other;
  }
  EXPECT_EQ(
      bakeKey("scene", specOf(R"({"environment": {"shadows": "rays", "sky": {}}})")),
      bakeKey("scene", specOf(R"({"environment": {"shadows": "rays", "sky": {}}, "ambient": {"intensity": 1}})")));
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
  report.lights.clear();
  report.environment = {.width = 32};
  const auto alone = readBakeReport(toJson(report).dump());
  ASSERT_TRUE(alone && alone->environment);
  EXPECT_EQ(alone->environment->width, 32);
}

Job sample() {
  return {.id = "0123456789abcdef0123456789abcdef",
          .state = JobState::failed,
          .scene = "scene",
          .first = 2,
          .done = 3,
          .of = 8,
          .bytes = 1u << 20,
          .created = "2031-05-04T13:02:01Z",
          .started = "2031-05-04T13:02:02Z",
          .expires = "2031-05-05T13:02:03Z",
          .problems = {{ProblemCode::notFound, "/frames/5/camera/node", "There is no such camera.", "", "nobody"}},
          .address = "/v1/jobs/0123456789abcdef0123456789abcdef",
          .result = "/v1/jobs/0123456789abcdef0123456789abcdef/result",
          .frames = "/v1/jobs/0123456789abcdef0123456789abcdef/frames/{index}"};
}

TEST(JobJson, IsReadAsItWasWritten) {
  const Json json = toJson(sample());
  EXPECT_EQ(json["state"], "failed");
  EXPECT_FALSE(json.contains("ended")) << "it has not";
  const auto read = readJob(jsonText(json));
  ASSERT_TRUE(read);
  EXPECT_EQ(toJson(*read), json);
  EXPECT_EQ(read->problems.at(0).code, ProblemCode::notFound);
  const auto list = readJobList(jsonText(toJson(JobList{{sample(), sample()}})));
  ASSERT_TRUE(list);
  EXPECT_EQ(list->jobs.size(), 2u);
}

TEST(JobJson, OtherTextsAreNoJobs) {
  for (const char* text : {"", "[]", "{}", "{\"id\": 7}", "not JSON", "{\"state\": \"done\"}"}) {
    EXPECT_FALSE(readJob(text)) << text;
    EXPECT_FALSE(readJobList(text)) << text;
  }
  Json newer = toJson(sample());
  newer["further"] = 1;
  EXPECT_TRUE(readJob(jsonText(newer))) << "a newer server may say more";
}

} // namespace
} // namespace gnomon
