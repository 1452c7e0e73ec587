#include "server/metrics/readings.h"

#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <unistd.h>

#include "server/metrics/request_metrics.h"

namespace gnomon::metrics {
namespace {

TEST(Readings, AreNamedByTheRulesAndEachOnce) {
  std::set<std::string> names;
  for (const auto& family : readingsOf({})) {
    EXPECT_TRUE(std::regex_match(family.name, std::regex("(gnomon|process)(_[a-z]+)+"))) << family.name;
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_EQ(family.name.ends_with("_total"), family.type == prometheus::MetricType::Counter) << family.name;
    EXPECT_EQ(family.help.back(), '.') << family.name;
  }
  for (const auto& family : RequestMetrics().collect()) EXPECT_TRUE(names.insert(family.name).second) << family.name;
}

TEST(Readings, TellTheSnapshot) {
  Snapshot snapshot;
  snapshot.workers.waitingByLane = {3, 2, 1};
  snapshot.workers.replacements[static_cast<std::size_t>(WorkerEnd::memory)] = 4;
  snapshot.uploads = {5, 6};
  snapshot.version = "1";
  snapshot.renderer.renderer = "a \"quoted\"\\ name\n";
  snapshot.renderer.device = DeviceChoice::cpu;
  const std::string text = metricsText(RequestMetrics(), snapshot);
  for (const char* line :
       {"gnomon_queue_tasks{lane=\"interactive\"} 3", "gnomon_queue_tasks{lane=\"load\"} 1",
        "gnomon_worker_replacements_total{reason=\"memory\"} 4", "gnomon_worker_replacements_total{reason=\"crash\"} 0",
        "gnomon_upload_memory_bytes 5", "gnomon_upload_memory_limit_bytes 6",
        R"(gnomon_build_info{version="1",device="cpu",renderer="a \"quoted\"\\ name\n"} 1)"}) {
    EXPECT_NE(text.find(std::string(line) + "\n"), std::string::npos) << line << "\n" << text;
  }
}

TEST(ProcessUse, IsThatOfThisProcess) {
  const ProcessUse use = processUse();
  EXPECT_GT(use.residentBytes, 1u << 20);
  EXPECT_GT(use.virtualBytes, use.residentBytes);
  EXPECT_GE(use.openFiles, 3u);
  EXPECT_GE(use.mostFiles, use.openFiles);
  EXPECT_GE(use.threads, 1u);
  const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  EXPECT_LT(use.startSeconds, now + 2);
  EXPECT_GT(use.startSeconds, now - 3600);
  const double before = use.processorSeconds;
  while (processUse().processorSeconds == before) {
  }
}

} // namespace
} // namespace gnomon::metrics
