#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

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
  EXPECT_EQ(names.size(), 20u);
  EXPECT_EQ(titles.size(), 20u);
  EXPECT_EQ(problemName(ProblemCode::hashMismatch), "hashMismatch");
}

TEST(ProblemJson, FitsItsSchema) {
  const Json schema = problemSchema();
  const Json json = problemJson({{.code = ProblemCode::busy, .detail = "Full.", .limit = "3"}}, 429, "id");
  EXPECT_EQ(checkAgainstSchema(json, schema, schema), "ok");
  EXPECT_EQ(checkAgainstSchema(Json::object(), schema, schema), "");
}

} // namespace
} // namespace gnomon
