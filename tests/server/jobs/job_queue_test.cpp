// What holds for every queue of jobs.
#include "server/jobs/job_queue.h"

#include <gtest/gtest.h>
#include <map>
#include <rapidcheck/gtest.h>
#include <set>
#include <thread>
#include <vector>

#include "server/system/clock.h"
#include "tests/server/jobs/tested_queue.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

TEST_P(JobQueueTest, ItsSizeIsThatOfItsJobs) {
  const auto expect = [&](std::size_t jobs, std::size_t framesLeft, std::uint64_t bytes) {
    const auto size = queue_->size();
    ASSERT_TRUE(size);
    EXPECT_EQ(size->jobs, jobs);
    EXPECT_EQ(size->framesLeft, framesLeft);
    EXPECT_EQ(size->bytes, bytes);
  };
  expect(0, 0, 0);
  const NewJob job = jobOfFrames("job", 3);
  put(job);
  put(jobOfFrames("other", 2));
  const std::uint64_t requests = 2 * job.request.size();
  expect(2, 5, requests);
  const FrameTurn turn = take();
  EXPECT_EQ(turn.job, "job");
  expect(2, 5, requests);
  finish(turn);
  const std::uint64_t picture = drawnFrame("job0").pictures.bytes().size();
  expect(2, 4, requests + picture);
  ASSERT_TRUE(queue_->fail(take(), {{ProblemCode::internal, "", "It did not work.", "", ""}}));
  expect(2, 2, requests + picture); // the turn was that of the other job
  ASSERT_TRUE(queue_->remove("job"));
  ASSERT_TRUE(queue_->remove("other"));
  expect(0, 0, 0);
}

TEST_P(JobQueueTest, EveryFrameIsTakenOnceAndKept) {
  put(jobOfFrames("job", 3));
  EXPECT_EQ(progress("job").state, JobState::queued);
  std::set<int> indices;
  for (int i = 0; i < 3; ++i) {
    const FrameTurn turn = take();
    EXPECT_EQ(turn.job, "job");
    EXPECT_EQ(turn.scene, "scene");
    EXPECT_EQ(turn.client, (ClientIdentity{"ann", "ann"}));
    EXPECT_EQ(turn.deliveries, 1);
    indices.insert(turn.index);
    EXPECT_EQ(progress("job").state, JobState::running);
    finish(turn);
    EXPECT_EQ(progress("job").done, i + 1);
  }
  EXPECT_EQ(indices, (std::set{0, 1, 2}));
  EXPECT_TRUE(isIdle());
  const JobProgress done = progress("job");
  EXPECT_EQ(done.state, JobState::done);
  EXPECT_EQ(done.bytes, 3 * std::string("job0").size());
  EXPECT_LE(done.created, done.started);
  EXPECT_LE(done.started, done.ended);
  EXPECT_GT(done.created, 1'600'000'000'000);
  const auto frame = queue_->frame("job", 1);
  ASSERT_TRUE(frame && *frame);
  const FrameNote& note = (*frame)->note;
  EXPECT_EQ(picture("job", 1), "job1");
  EXPECT_EQ(note.contentKey, contentKeyOf("job1"));
  EXPECT_EQ(note.warnings, std::vector<std::string>{"a warning"});
  EXPECT_EQ(note.pictures.at(0).contentType, "image/png");
  EXPECT_EQ(note.stages.at(0).milliseconds, 1.5);
  EXPECT_EQ(note.milliseconds, 2.5);
  EXPECT_EQ(picture("job", 7), "none");
  EXPECT_EQ(picture("other", 0), "none");
}

TEST_P(JobQueueTest, ARequestIsGivenBackAsItCame) {
  NewJob job = jobOfFrames("job", 1);
  job.request = "{\"frames\": [{}], \"text\": \"\\u0000\xc3\xa9\"}";
  put(job);
  const auto request = queue_->request("job");
  ASSERT_TRUE(request && *request);
  EXPECT_EQ(**request, job.request);
  EXPECT_FALSE(**queue_->request("job") == "" || queue_->request("none")->has_value());
}

TEST_P(JobQueueTest, AChainedFrameComesWithWhatTheFramesBeforeItLeft) {
  NewJob job = jobOfFrames("job", 5);
  job.first = 2;
  job.isChained = true;
  job.carried.depthRanges = {{0, 1, 9}};
  put(job);
  FrameTurn turn = take();
  EXPECT_EQ(turn.index, 2);
  EXPECT_EQ(turn.before, job.carried);
  EXPECT_TRUE(isIdle()) << "the next waits for it";
  ASSERT_TRUE(queue_->finish(turn, drawnFrame("a", {{{1, 2, 8.25}}})));
  turn = take();
  EXPECT_EQ(turn.index, 3);
  EXPECT_EQ(turn.before, (Carried{{{0, 1, 9}, {1, 2, 8.25}}}));
  ASSERT_TRUE(queue_->finish(turn, drawnFrame("b")));
  turn = take();
  EXPECT_EQ(turn.before, (Carried{{{0, 1, 9}, {1, 2, 8.25}}}));
  finish(turn);
  EXPECT_TRUE(isIdle());
  EXPECT_EQ(progress("job").state, JobState::done);
  EXPECT_EQ(progress("job").carried, job.carried);
  EXPECT_EQ(progress("job").done, 3);
}

TEST_P(JobQueueTest, TheSecondToFinishAFrameChangesNothing) {
  NewJob job = jobOfFrames("job", 2);
  job.isChained = true;
  put(job);
  const FrameTurn turn = take();
  ASSERT_TRUE(queue_->finish(turn, drawnFrame("first", {{{0, 1, 2}}})));
  ASSERT_TRUE(queue_->finish(turn, drawnFrame("second", {{{0, 3, 4}}})));
  EXPECT_EQ(progress("job").done, 1);
  EXPECT_EQ(picture("job", 0), "first");
  const FrameTurn next = take();
  EXPECT_EQ(next.before, (Carried{{{0, 1, 2}}}));
  EXPECT_TRUE(isIdle()) << "the next is queued once";
}

TEST_P(JobQueueTest, AFailedFrameEndsItsJobAlone) {
  put(jobOfFrames("bad", 3));
  put(jobOfFrames("good", 1));
  std::map<std::string, FrameTurn> turns;
  while (turns.size() < 2) {
    FrameTurn turn = take();
    turns.insert_or_assign(turn.job, turn);
  }
  const Problem problem{ProblemCode::notFound, "/frames/1/camera/node", "There is no such camera.", "a", "b"};
  ASSERT_TRUE(queue_->fail(turns["bad"], {problem}));
  finish(turns["bad"]);
  finish(turns["good"]);
  EXPECT_TRUE(isIdle()) << "frames of a failed job are not drawn any more";
  const JobProgress bad = progress("bad");
  EXPECT_EQ(bad.state, JobState::failed);
  EXPECT_GT(bad.ended, 0);
  ASSERT_EQ(bad.problems.size(), 1u);
  EXPECT_EQ(bad.problems[0].code, problem.code);
  EXPECT_EQ(bad.problems[0].pointer, problem.pointer);
  EXPECT_EQ(bad.problems[0].detail, problem.detail);
  EXPECT_EQ(bad.problems[0].limit, problem.limit);
  EXPECT_EQ(progress("good").state, JobState::done);
}

TEST_P(JobQueueTest, WhatIsRemovedIsGoneAndNotDrawnAnyMore) {
  put(jobOfFrames("job", 3));
  const FrameTurn turn = take();
  EXPECT_TRUE(*queue_->renew(turn));
  finish(turn);
  const FrameTurn second = take();
  EXPECT_TRUE(*queue_->remove("job"));
  EXPECT_FALSE(*queue_->remove("job"));
  EXPECT_FALSE(*queue_->renew(second)) << "so that whoever draws it stops";
  finish(second);
  EXPECT_TRUE(isIdle());
  EXPECT_FALSE(queue_->find("job")->has_value());
  EXPECT_EQ(picture("job", 0), "none");
  EXPECT_EQ(picture("job", second.index), "none");
}

TEST_P(JobQueueTest, AFrameThatIsGivenBackComesAgain) {
  put(jobOfFrames("job", 1));
  ASSERT_TRUE(queue_->giveBack(take(), false));
  const FrameTurn untried = take();
  EXPECT_EQ(untried.deliveries, 1);
  ASSERT_TRUE(queue_->giveBack(untried, true));
  const FrameTurn tried = take();
  EXPECT_EQ(tried.deliveries, 2);
  EXPECT_TRUE(isIdle());
  finish(tried);
  EXPECT_EQ(progress("job").state, JobState::done);
}

TEST_P(JobQueueTest, AFrameWhoseTakerIsSilentGoesToOthersAndTheFirstToFinishCounts) {
  open({.lease = 40ms});
  put(jobOfFrames("job", 1));
  const FrameTurn first = take();
  const FrameTurn second = take(); // waits until the first taker was silent for long enough
  EXPECT_EQ(second.deliveries, 2);
  EXPECT_EQ(second.index, first.index);
  ASSERT_TRUE(queue_->finish(first, drawnFrame("late")));
  ASSERT_TRUE(queue_->finish(second, drawnFrame("second")));
  EXPECT_EQ(picture("job", 0), "late");
  EXPECT_EQ(progress("job").done, 1);
  EXPECT_TRUE(isIdle());
}

TEST_P(JobQueueTest, AFrameThatNobodySurvivesFailsItsJob) {
  open({.deliveries = 3, .lease = 20ms});
  put(jobOfFrames("poison", 1));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(take().deliveries, i + 1);
  const auto end = Clock::now() + 10s;
  while (progress("poison").state != JobState::failed && Clock::now() < end)
    EXPECT_FALSE(queue_->take(20ms)->has_value());
  const JobProgress failed = progress("poison");
  EXPECT_EQ(failed.state, JobState::failed);
  ASSERT_EQ(failed.problems.size(), 1u);
  EXPECT_EQ(failed.problems[0].code, ProblemCode::internal);
  EXPECT_EQ(failed.problems[0].actual, "3 times");
}

TEST_P(JobQueueTest, AListHasTheJobsOfItsKeyTheNewestFirst) {
  for (const char* id : {"a", "b", "c"}) put(jobOfFrames(id, 1));
  put(jobOfFrames("d", 1, "bob"));
  const auto list = queue_->list("ann");
  ASSERT_TRUE(list);
  std::vector<std::string> ids;
  for (const JobProgress& job : *list) ids.push_back(job.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"c", "b", "a"}));
  EXPECT_EQ(queue_->list("nobody")->size(), 0u);
  EXPECT_EQ(queue_->list(std::nullopt)->size(), 4u);
}

TEST_P(JobQueueTest, AJobGoesWhenItIsTooOld) {
  open({.age = 1s});
  put(jobOfFrames("job", 2));
  finish(take());
  const auto end = Clock::now() + 10s;
  while (queue_->find("job")->has_value() && Clock::now() < end) std::this_thread::yield();
  EXPECT_FALSE(queue_->find("job")->has_value());
  EXPECT_EQ(picture("job", 0), "none");
  EXPECT_TRUE(isIdle());
  EXPECT_EQ(queue_->list("ann")->size(), 0u);
}

/// Takes, finishes, gives back and loses frames in any order, and twice.
TEST_P(JobQueueTest, WhateverHappensEachFrameIsThereOnceAsItWasFirstFinished) {
  rc::check([&] {
    GetParam().clear();
    open({.deliveries = 1'000'000, .lease = 0ms}); // whoever took a frame may lose it at once
    std::map<std::string, int> counts;
    for (const char* id : {"a", "b", "c"}) {
      NewJob job = jobOfFrames(id, *rc::gen::inRange(1, 5), *rc::gen::element("ann", "bob"));
      job.isChained = *rc::gen::arbitrary<bool>();
      counts[id] = job.count;
      put(job);
    }
    std::vector<FrameTurn> turns;
    std::map<std::pair<std::string, int>, std::string> first;
    const auto finishOne = [&](const FrameTurn& turn) {
      const std::string content = turn.receipt + "/" + std::to_string(turn.deliveries);
      RC_ASSERT(queue_->finish(turn, drawnFrame(content)));
      first.emplace(std::pair(turn.job, turn.index), content);
    };
    for (int step = *rc::gen::inRange(0, 30); step > 0; --step) {
      const int what = *rc::gen::inRange(0, 4);
      if (what < 2 || turns.empty()) {
        if (auto turn = queue_->take(0ms); turn && *turn) turns.push_back(**turn);
        continue;
      }
      const FrameTurn& turn = turns[*rc::gen::inRange<std::size_t>(0, turns.size())];
      if (what == 2) {
        finishOne(turn);
      } else {
        RC_ASSERT(queue_->giveBack(turn, *rc::gen::arbitrary<bool>()));
      }
    }
    for (auto turn = queue_->take(0ms); turn && *turn; turn = queue_->take(0ms)) finishOne(**turn);
    for (const auto& [id, count] : counts) {
      RC_ASSERT(progress(id).state == JobState::done);
      RC_ASSERT(progress(id).done == count);
      for (int index = 0; index < count; ++index) RC_ASSERT(picture(id, index) == first.at({id, index}));
    }
  });
}

TEST_P(JobQueueTest, ManyTakersDrawEachFrameOnce) {
  constexpr int kFrames = 200;
  put(jobOfFrames("job", kFrames));
  std::vector<std::unique_ptr<JobQueue>> others;
  std::vector<std::thread> takers;
  std::mutex mutex;
  std::multiset<int> taken;
  for (int i = 0; i < 4; ++i) {
    if (GetParam().isShared) others.push_back(GetParam().open(limits_));
    JobQueue& queue = GetParam().isShared ? *others.back() : *queue_;
    takers.emplace_back([&] {
      for (auto turn = queue.take(0ms); turn && *turn; turn = queue.take(0ms)) {
        EXPECT_TRUE(queue.finish(**turn, drawnFrame(std::to_string((*turn)->index))));
        const std::lock_guard lock(mutex);
        taken.insert((*turn)->index);
      }
    });
  }
  for (std::thread& taker : takers) taker.join();
  EXPECT_EQ(taken.size(), std::size_t(kFrames));
  EXPECT_EQ(std::set(taken.begin(), taken.end()).size(), std::size_t(kFrames));
  EXPECT_EQ(progress("job").state, JobState::done);
  for (int i = 0; i < kFrames; ++i) EXPECT_EQ(picture("job", i), std::to_string(i));
}

INSTANTIATE_TEST_SUITE_P(Every, JobQueueTest, ::testing::ValuesIn(testedQueues()),
                         [](const auto& tested) { return tested.param.name; });

} // namespace
} // namespace gnomon
