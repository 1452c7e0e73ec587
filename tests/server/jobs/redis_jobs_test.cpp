#include "server/jobs/redis_jobs.h"

#include <functional>
#include <gtest/gtest.h>
#include <thread>

#include "protocol/json/json_codec.h"
#include "server/jobs/job_text.h"
#include "tests/server/jobs/tested_queue.h"
#include "tests/support/redis_server.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

class RedisJobsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!testing::RedisServer::isInstalled()) GTEST_SKIP() << "redis-server is not installed.";
    server_ = std::make_unique<testing::RedisServer>();
    options_.address = *redis::parseAddress(server_->url());
    queue_ = open(JobLimits{});
  }

  /// The queue of a process of its own.
  std::unique_ptr<RedisJobs> open(const JobLimits& limits) {
    return std::make_unique<RedisJobs>(limits, std::make_shared<redis::Redis>(options_));
  }

  /// Asks until the server is reached again.
  std::optional<JobProgress> progress(const std::string& job) {
    for (const auto end = Clock::now() + 20s; Clock::now() < end; std::this_thread::yield()) {
      const auto found = queue_->find(job);
      if (found) return *found;
    }
    return std::nullopt;
  }

  std::vector<std::string> keys() {
    redis::Redis redis(options_);
    std::vector<std::string> names;
    const auto reply = redis.ask({"KEYS", "*"}, {Clock::now() + 10s});
    for (const auto& each : reply->elements) names.push_back(each.text);
    std::sort(names.begin(), names.end());
    return names;
  }

  std::unique_ptr<testing::RedisServer> server_;
  redis::Options options_;
  std::unique_ptr<RedisJobs> queue_;
};

TEST_F(RedisJobsTest, WhileRedisIsAwayEverythingIsUnavailableAndNothingIsLost) {
  ASSERT_TRUE(queue_->put(jobOfFrames("job", 3)));
  const auto first = queue_->take(5s);
  const auto second = queue_->take(5s);
  ASSERT_TRUE(first && *first && second && *second);
  ASSERT_TRUE(queue_->finish(**first, drawnFrame("first")));
  server_->kill();
  const auto isAway = [](const auto& result) {
    return !result && result.problems().front().code == ProblemCode::unavailable;
  };
  EXPECT_TRUE(isAway(queue_->put(jobOfFrames("other", 1))));
  EXPECT_TRUE(isAway(queue_->take(0ms)));
  EXPECT_TRUE(isAway(queue_->renew(**second)));
  EXPECT_TRUE(isAway(queue_->finish(**second, drawnFrame("second"))));
  EXPECT_TRUE(isAway(queue_->find("job")));
  EXPECT_TRUE(isAway(queue_->list("ann")));
  EXPECT_TRUE(isAway(queue_->note("job", 0)));
  EXPECT_TRUE(isAway(queue_->frame("job", 0)));
  EXPECT_TRUE(isAway(queue_->request("job")));
  EXPECT_TRUE(isAway(queue_->remove("job")));
  server_->start();
  const auto back = progress("job");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->done, 1);
  EXPECT_TRUE(*queue_->renew(**second)) << "what was taken is still known";
  ASSERT_TRUE(queue_->finish(**second, drawnFrame("second")));
  const auto third = queue_->take(5s);
  ASSERT_TRUE(third && *third);
  ASSERT_TRUE(queue_->finish(**third, drawnFrame("third")));
  EXPECT_EQ(progress("job")->state, JobState::done);
  EXPECT_EQ((*queue_->frame("job", (*first)->index))->pictures.bytes(), "first");
}

TEST_F(RedisJobsTest, AFrameOfAProcessThatDiedIsTakenOverByAnother) {
  JobLimits limits{.lease = 50ms};
  {
    const auto dead = open(limits);
    ASSERT_TRUE(dead->put(jobOfFrames("job", 1)));
    ASSERT_TRUE(*dead->take(5s));
  }
  const auto living = open(limits);
  const auto turn = living->take(10s);
  ASSERT_TRUE(turn && *turn);
  EXPECT_EQ((*turn)->deliveries, 2);
  ASSERT_TRUE(living->finish(**turn, drawnFrame("picture")));
  EXPECT_EQ(progress("job")->state, JobState::done);
}

TEST_F(RedisJobsTest, AFrameThatIsRenewedIsNotTakenOver) {
  JobLimits limits{.lease = 300ms};
  const auto slow = open(limits);
  const auto other = open(limits);
  ASSERT_TRUE(slow->put(jobOfFrames("job", 1)));
  const auto turn = slow->take(5s);
  ASSERT_TRUE(turn && *turn);
  for (const auto end = Clock::now() + 1s; Clock::now() < end;) {
    EXPECT_TRUE(*slow->renew(**turn));
    EXPECT_FALSE(other->take(50ms)->has_value());
  }
}

TEST_F(RedisJobsTest, WhatWasRemovedLeavesNoKey) {
  const std::vector<std::string> empty{"gnomon:jobs:bytes", "gnomon:jobs:count"};
  for (const char* id : {"done", "failed", "open"}) ASSERT_TRUE(queue_->put(jobOfFrames(id, 2)));
  for (int i = 0; i < 5; ++i) {
    const auto turn = queue_->take(5s);
    ASSERT_TRUE(turn && *turn);
    if ((*turn)->job == "done") {
      ASSERT_TRUE(queue_->finish(**turn, drawnFrame("picture")));
    } else if ((*turn)->job == "failed") {
      ASSERT_TRUE(queue_->fail(**turn, {Problem{}}));
    }
  }
  for (const char* id : {"done", "failed", "open"}) EXPECT_TRUE(*queue_->remove(id));
  EXPECT_EQ(keys(), empty);
  redis::Redis redis(options_);
  const auto bytes = redis.ask({"GET", "gnomon:jobs:bytes"}, {Clock::now() + 10s});
  EXPECT_EQ(bytes->text, "0");
}

/// What a frame's note in Redis is replaced by, and whether the frame is still given.
class PoisonedRedisTest : public RedisJobsTest {
 protected:
  void SetUp() override {
    RedisJobsTest::SetUp();
    if (IsSkipped()) return;
    ASSERT_TRUE(queue_->put(jobOfFrames("job", 2)));
    const auto turn = queue_->take(5s);
    ASSERT_TRUE(turn && *turn && queue_->finish(**turn, drawnFrame("picture")));
    index_ = (*turn)->index;
  }

  redis::Reply ask(const redis::Command& command) {
    redis::Redis redis(options_);
    auto reply = redis.ask(command, {Clock::now() + 10s});
    return reply ? *std::move(reply) : redis::Reply{};
  }

  std::string frameKey() const { return "gnomon:jobs:frame:job:" + std::to_string(index_); }

  /// Sets a field of the job, asks for it, and puts the field back.
  std::string problemWith(const std::string& field, const std::string& value) {
    const std::string before = ask({"HGET", "gnomon:jobs:job:job", field}).text;
    ask({"HSET", "gnomon:jobs:job:job", field, value});
    const auto found = queue_->find("job");
    EXPECT_EQ(queue_->list("ann")->size(), found ? 1u : 0u) << "and no list has it";
    ask({"HSET", "gnomon:jobs:job:job", field, before});
    return found ? "" : std::string(problemName(found.problems()[0].code));
  }

  int index_ = 0;
};

TEST_F(PoisonedRedisTest, ANoteThatDoesNotFitItsPicturesIsAProblem) {
  const std::string good = ask({"HGET", frameKey(), "note"}).text;
  const FrameNote written = *readFrameNote(good);
  const auto problem = [&](const std::function<void(FrameNote&)>& change) {
    FrameNote changed = written;
    change(changed);
    ask({"HSET", frameKey(), "note", textOf(changed)});
    const auto frame = queue_->frame("job", index_);
    ask({"HSET", frameKey(), "note", good});
    return frame ? "" : std::string(problemName(frame.problems()[0].code));
  };
  EXPECT_EQ(problem([](FrameNote&) {}), "");
  EXPECT_EQ(problem([](FrameNote& note) { note.pictures[0].bytes = 1'000'000; }), "internal");
  EXPECT_EQ(problem([](FrameNote& note) { note.pictures[0].bytes -= 1; }), "internal");
  EXPECT_EQ(problem([](FrameNote& note) {
              note.pictures = {{"color", "image/png", ~0ull}, {"depth", "image/png", 8}}; // 7 = "picture"
            }),
            "internal");
  EXPECT_EQ(problem([](FrameNote& note) { note.pictures.clear(); }), "internal");
  EXPECT_EQ(problem([](FrameNote& note) { note.pictures[0].view = "color\r\nX: y"; }), "internal");
  EXPECT_EQ(problem([](FrameNote& note) { note.pictures[0].contentType = "image/png\r\nX: y"; }), "internal");
  EXPECT_EQ(problem([](FrameNote& note) { note.contentKey = "a\"\r\nX: y"; }), "internal");
  EXPECT_EQ(problem([](FrameNote& note) { note.stages = {{"a\r\nX: y", 1}}; }), "internal");
  EXPECT_EQ(problem([](FrameNote& note) { note.milliseconds = -1; }), "internal");
  ask({"HSET", frameKey(), "pictures", "pictures"});
  EXPECT_FALSE(queue_->frame("job", index_)) << "the bytes are longer than the note says";
}

TEST_F(PoisonedRedisTest, AJobWhoseNumbersAreNoneIsAProblem) {
  EXPECT_EQ(problemWith("done", "2"), "");
  for (const char* number : {"", "x", "-1", "3", "1x", "99999999999999999999"}) {
    EXPECT_EQ(problemWith("done", number), "internal") << number;
  }
  EXPECT_EQ(problemWith("count", "0"), "internal");
  EXPECT_EQ(problemWith("count", "2000000000"), "internal");
  EXPECT_EQ(problemWith("first", "-1"), "internal");
  EXPECT_EQ(problemWith("bytes", "18446744073709551615"), "internal");
  EXPECT_EQ(problemWith("created", "9223372036854775807"), "internal");
  EXPECT_EQ(problemWith("state", "nothing"), "internal");
  EXPECT_EQ(problemWith("state", "failed"), "internal") << "its list of problems is empty";
}

TEST_F(PoisonedRedisTest, AFrameWhoseIndexIsNoneIsNotDrawn) {
  ask({"XADD", "gnomon:jobs:stream:job", "*", "index", "-1", "carried", textOf(Carried{})});
  std::vector<std::string> ends;
  for (int i = 0; i < 2; ++i) {
    const auto turn = queue_->take(5s);
    ends.push_back(!turn ? std::string(problemName(turn.problems()[0].code)) : *turn ? "taken" : "none");
  }
  EXPECT_EQ(ends, (std::vector<std::string>{"taken", "internal"}));
}

} // namespace
} // namespace gnomon
