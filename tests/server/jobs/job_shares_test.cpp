// What each client may have of a queue of jobs: turns, jobs, bytes.
#include <map>
#include <string>

#include "tests/server/jobs/tested_queue.h"

namespace gnomon {
namespace {

class JobSharesTest : public JobQueueTest {};

TEST_P(JobSharesTest, ClientsTakeTurnsAndSoDoTheirJobs) {
  put(jobOfFrames("long", 6, "ann"));
  put(jobOfFrames("other", 6, "ann"));
  put(jobOfFrames("short", 3, "bob"));
  std::map<std::string, int> taken;
  for (int i = 0; i < 6; ++i) ++taken[take().job];
  EXPECT_EQ(taken["short"], 3) << "bob has every second turn";
  EXPECT_GE(taken["long"], 1);
  EXPECT_GE(taken["other"], 1);
}

TEST_P(JobSharesTest, AClientHasOnlySoManyJobs) {
  open({.jobsOfClient = 2});
  put(jobOfFrames("a", 1));
  put(jobOfFrames("b", 1));
  const auto refused = queue_->put(jobOfFrames("c", 1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].code, ProblemCode::busy);
  EXPECT_EQ(refused.problems()[0].limit, "2 jobs");
  EXPECT_FALSE(queue_->find("c")->has_value());
  put(jobOfFrames("d", 1, "bob"));
  EXPECT_TRUE(*queue_->remove("a"));
  put(jobOfFrames("c", 1));
}

TEST_P(JobSharesTest, AClientHasHalfOfTheJobsThatOthersLeave) {
  open({.jobs = 8});
  for (int i = 0; i < 4; ++i) put(jobOfFrames("ann" + std::to_string(i), 1));
  const auto refused = queue_->put(jobOfFrames("ann4", 1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].code, ProblemCode::busy);
  EXPECT_EQ(refused.problems()[0].limit, "8 jobs");
  put(jobOfFrames("bob0", 1, "bob"));
  put(jobOfFrames("bob1", 1, "bob"));
  EXPECT_FALSE(queue_->put(jobOfFrames("bob2", 1, "bob")));
  EXPECT_TRUE(*queue_->remove("ann0"));
  EXPECT_TRUE(*queue_->remove("ann1"));
  EXPECT_TRUE(queue_->put(jobOfFrames("bob2", 1, "bob"))) << "what was removed is free again";
}

TEST_P(JobSharesTest, TheNetworksOfOneSiteLeaveJobsToOthersAndTakeTurnsWithThem) {
  open({.jobs = 16});
  int kept = 0;
  for (int i = 0; i < 20; ++i) {
    NewJob job = jobOfFrames("of site " + std::to_string(i), 1);
    job.client = {"2001:db8:0:" + std::to_string(i) + "::/64", "2001:db8::/48"};
    kept += queue_->put(job) ? 1 : 0;
  }
  EXPECT_EQ(kept, 12);
  put(jobOfFrames("modest", 1, "192.0.2.9"));
  const FrameTurn first = take();
  EXPECT_EQ(first.client.site, "2001:db8::/48");
  EXPECT_EQ(take().job, "modest") << "it does not wait for all of theirs";
}

TEST_P(JobSharesTest, WhatHasNoRoomIsRefusedOrFails) {
  open({.bytes = 100});
  NewJob large = jobOfFrames("large", 1);
  large.request = std::string(101, ' ');
  const auto refused = queue_->put(large);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].code, ProblemCode::insufficientStorage);
  put(jobOfFrames("job", 2));
  ASSERT_TRUE(queue_->finish(take(), drawnFrame(std::string(60, 'a'))));
  ASSERT_TRUE(queue_->finish(take(), drawnFrame(std::string(60, 'b'))));
  EXPECT_EQ(progress("job").state, JobState::failed);
  EXPECT_EQ(progress("job").problems.at(0).code, ProblemCode::insufficientStorage);
  EXPECT_EQ(progress("job").done, 1);
  EXPECT_TRUE(*queue_->remove("job"));
  put(jobOfFrames("after", 1));
  ASSERT_TRUE(queue_->finish(take(), drawnFrame(std::string(90, 'c'))));
  EXPECT_EQ(progress("after").state, JobState::done) << "what was removed made room";
}

/// Of `queue`: a job of `client` whose one picture has so many bytes. What became of it.
JobState drawOf(JobQueue& queue, const std::string& id, const ClientIdentity& client, std::size_t bytes) {
  NewJob job = jobOfFrames(id, 1);
  job.client = client;
  EXPECT_TRUE(queue.put(job)) << id;
  const auto turn = queue.take(std::chrono::seconds(5));
  EXPECT_TRUE(turn && *turn) << id;
  EXPECT_TRUE(queue.finish(**turn, drawnFrame(std::string(bytes, 'p')))) << id;
  return (*queue.find(id))->state;
}

TEST_P(JobSharesTest, OneJobMayHaveAllBytesAndAllOfAClientThreeQuarters) {
  open({.bytes = 1'000});
  const ClientIdentity ann{"ann", "ann"}, bob{"bob", "bob"};
  EXPECT_EQ(drawOf(*queue_, "alone", ann, 990), JobState::done);
  EXPECT_TRUE(*queue_->remove("alone"));
  EXPECT_EQ(drawOf(*queue_, "first", ann, 500), JobState::done);
  EXPECT_EQ(drawOf(*queue_, "second", ann, 300), JobState::failed) << "with the first it has more than 750";
  EXPECT_EQ(progress("second").problems.at(0).code, ProblemCode::insufficientStorage);
  EXPECT_EQ(progress("second").problems.at(0).limit, "1000 bytes");
  EXPECT_NE(progress("second").problems.at(0).detail.find("its share"), std::string::npos);
  EXPECT_EQ(drawOf(*queue_, "of another", bob, 300), JobState::done) << "there was room for those who have none";
  EXPECT_TRUE(*queue_->remove("first"));
  EXPECT_EQ(drawOf(*queue_, "third", ann, 300), JobState::done) << "what was removed is free again";
}

TEST_P(JobSharesTest, ANewJobIsRefusedWhereItsClientHasItsShareOfBytes) {
  open({.bytes = 1'000});
  EXPECT_EQ(drawOf(*queue_, "large", {"ann", "ann"}, 740), JobState::done);
  NewJob next = jobOfFrames("next", 1);
  next.request = std::string(20, ' ');
  const auto refused = queue_->put(next);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].code, ProblemCode::busy);
  EXPECT_EQ(refused.problems()[0].limit, "1000 bytes");
  next.client = {"bob", "bob"};
  put(next);
}

TEST_P(JobSharesTest, TheNetworksOfOneSiteHaveOneShareOfBytes) {
  open({.bytes = 1'000});
  const auto ofSite = [](int i) -> ClientIdentity {
    return {"2001:db8:0:" + std::to_string(i) + "::/64", "2001:db8::/48"};
  };
  EXPECT_EQ(drawOf(*queue_, "a", ofSite(1), 400), JobState::done);
  EXPECT_EQ(drawOf(*queue_, "b", ofSite(2), 300), JobState::done);
  EXPECT_EQ(drawOf(*queue_, "c", ofSite(3), 100), JobState::failed);
  EXPECT_EQ(drawOf(*queue_, "d", {"192.0.2.9", "192.0.2.9"}, 100), JobState::done);
}

INSTANTIATE_TEST_SUITE_P(Every, JobSharesTest, ::testing::ValuesIn(testedQueues()),
                         [](const auto& tested) { return tested.param.name; });

} // namespace
} // namespace gnomon
