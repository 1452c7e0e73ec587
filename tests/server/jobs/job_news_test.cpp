#include "server/jobs/job_news.h"

#include <functional>
#include <gtest/gtest.h>
#include <thread>

#include "server/jobs/local_jobs.h"
#include "tests/server/jobs/tested_queue.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

class JobNewsTest : public ::testing::Test {
 protected:
  std::shared_ptr<const JobNews::Watched> watch(const std::string& job) { return news_.watch(**jobs_.find(job)); }

  static bool eventually(const std::function<bool()>& is) {
    for (const auto end = Clock::now() + 10s; Clock::now() < end; std::this_thread::sleep_for(2ms)) {
      if (is()) return true;
    }
    return false;
  }

  LocalJobs jobs_{JobLimits{}, ""};
  JobNews news_{jobs_};
};

TEST_F(JobNewsTest, EveryChangeIsSeenByAllThatWait) {
  ASSERT_TRUE(jobs_.put(jobOfFrames("job", 1)));
  const auto first = watch("job"), second = watch("job");
  EXPECT_EQ((*first->latest())->state, JobState::queued);
  const auto turn = jobs_.take(0ms);
  EXPECT_TRUE(eventually([&] { return (*first->latest())->state == JobState::running; }));
  ASSERT_TRUE(jobs_.finish(**turn, drawnFrame("picture")));
  for (const auto& each : {first, second}) {
    EXPECT_TRUE(eventually([&] { return (*each->latest())->state == JobState::done; }));
    EXPECT_EQ((*each->latest())->done, 1);
  }
}

TEST_F(JobNewsTest, NewsWakesThoseThatWait) {
  ASSERT_TRUE(jobs_.put(jobOfFrames("job", 1)));
  const auto watched = watch("job");
  const auto wake = std::make_shared<StopSignal>();
  watched->wakeBy(wake);
  EXPECT_FALSE(wake->waitFor(100ms)) << "nothing has happened";
  ASSERT_TRUE(jobs_.take(0ms));
  EXPECT_TRUE(wake->waitFor(10s));
  EXPECT_EQ((*watched->latest())->state, JobState::running);
  wake->lower();
  EXPECT_FALSE(wake->raised());
}

TEST_F(JobNewsTest, AJobThatIsRemovedIsCancelled) {
  ASSERT_TRUE(jobs_.put(jobOfFrames("job", 1)));
  const auto watched = watch("job");
  ASSERT_TRUE(*jobs_.remove("job"));
  EXPECT_TRUE(eventually([&] { return (*watched->latest())->state == JobState::cancelled; }));
}

TEST_F(JobNewsTest, WhatACallerHasSeenIsNeverFollowedByLess) {
  ASSERT_TRUE(jobs_.put(jobOfFrames("job", 200)));
  const auto watched = watch("job");
  for (int done = 0; done < 200; ++done) {
    ASSERT_TRUE(jobs_.finish(**jobs_.take(0ms), drawnFrame("picture")));
    const auto again = watch("job"); // which has just been looked at
    EXPECT_GE((*again->latest())->done, done + 1);
  }
}

} // namespace
} // namespace gnomon
