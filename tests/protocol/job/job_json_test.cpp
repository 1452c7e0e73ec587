#include "protocol/job/job_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

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
