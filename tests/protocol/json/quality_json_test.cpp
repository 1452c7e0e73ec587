#include "protocol/json/quality_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

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

} // namespace
} // namespace gnomon
