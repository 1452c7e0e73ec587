#include "tests/server/jobs/tested_queue.h"

#include "server/jobs/local_jobs.h"
#include "server/jobs/redis_jobs.h"
#include "server/redis/redis.h"
#include "tests/support/redis_server.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

const TestedQueue kInMemory{
    "InMemory", false, [] {},
    [](const JobLimits& limits) -> std::unique_ptr<JobQueue> { return std::make_unique<LocalJobs>(limits, ""); }};
const TestedQueue kInDirectory{"InDirectory", false, [] {},
                               [](const JobLimits& limits) -> std::unique_ptr<JobQueue> {
                                 return std::make_unique<LocalJobs>(limits, ::testing::TempDir());
                               }};

std::optional<redis::Options> redisOptions() {
  static const auto server = testing::RedisServer::isInstalled() ? std::make_unique<testing::RedisServer>() : nullptr;
  if (!server) return std::nullopt;
  return redis::Options{.address = *redis::parseAddress(server->url())};
}

const TestedQueue kInRedis{
    "InRedis", true,
    [] {
      const auto options = redisOptions();
      if (options) {
        ASSERT_TRUE(redis::Redis(*options).ask({"FLUSHALL"}, {Clock::now() + 10s}));
      }
    },
    [](const JobLimits& limits) -> std::unique_ptr<JobQueue> {
      const auto options = redisOptions();
      return options ? std::make_unique<RedisJobs>(limits, std::make_shared<redis::Redis>(*options)) : nullptr;
    }};

} // namespace

std::vector<TestedQueue> testedQueues() {
  return {kInMemory, kInDirectory, kInRedis};
}

} // namespace gnomon
