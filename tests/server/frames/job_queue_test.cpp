#include "server/frames/job_queue.h"

#include <future>
#include <gtest/gtest.h>
#include <list>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

/// A job whose outcome can be waited for: "run", or the code of why it was dropped.
struct Watched {
  std::promise<std::string> promise;
  std::future<std::string> outcome = promise.get_future();

  Job job(std::function<void()> work = {}) {
    Job made;
    made.deadline = Clock::now() + 1h;
    made.run = [this, work = std::move(work)](double) {
      if (work) {
        work();
      }
      promise.set_value("run");
    };
    made.drop = [this](const Problem& problem) {
      promise.set_value(problem.code == ProblemCode::deadlineExceeded ? "late" : "closed");
    };
    return made;
  }
};

/// Keeps the queue's thread busy until it is let go.
struct Blocker {
  explicit Blocker(JobQueue& queue) {
    Job job;
    job.deadline = Clock::now() + 1h;
    job.run = [this](double) {
      running.set_value();
      release.get_future().wait();
    };
    job.drop = [](const Problem&) {};
    EXPECT_FALSE(queue.submit(std::move(job)));
    running.get_future().wait();
  }
  std::promise<void> running;
  std::promise<void> release;
};

TEST(JobQueue, RunsInOrder) {
  JobQueue queue(4);
  std::string order;
  Watched a, b;
  EXPECT_FALSE(queue.submit(a.job([&] { order += "a"; })));
  EXPECT_FALSE(queue.submit(b.job([&] { order += "b"; })));
  EXPECT_EQ(b.outcome.get(), "run");
  EXPECT_EQ(order, "ab");
}

TEST(JobQueue, RefusesWhenFull) {
  JobQueue queue(2);
  Watched a, b, c;
  Blocker blocker(queue);
  EXPECT_FALSE(queue.submit(a.job()));
  EXPECT_FALSE(queue.submit(b.job()));
  EXPECT_EQ(queue.waiting(), 2u);
  const auto full = queue.submit(c.job());
  ASSERT_TRUE(full);
  EXPECT_EQ(full->limit, 2u);
  EXPECT_GE(full->retryAfterSeconds, 1);
  blocker.release.set_value();
  EXPECT_EQ(b.outcome.get(), "run");
}

TEST(JobQueue, DropsWhatIsLateOrUnwanted) {
  JobQueue queue(4);
  Watched late, unwanted, good;
  Blocker blocker(queue);
  Job first = late.job();
  first.deadline = Clock::now();
  Job second = unwanted.job();
  second.wanted = [] { return false; };
  EXPECT_FALSE(queue.submit(std::move(first)));
  EXPECT_FALSE(queue.submit(std::move(second)));
  EXPECT_FALSE(queue.submit(good.job()));
  blocker.release.set_value();
  EXPECT_EQ(late.outcome.get(), "late");
  EXPECT_EQ(unwanted.outcome.get(), "late");
  EXPECT_EQ(good.outcome.get(), "run");
}

TEST(JobQueue, FinishesWithinTheGrace) {
  std::thread::id ended;
  std::thread::id ran;
  Watched a, b;
  {
    JobQueue queue(4, [&] { ended = std::this_thread::get_id(); });
    EXPECT_FALSE(queue.submit(a.job([&] { ran = std::this_thread::get_id(); })));
    queue.close(Clock::now() + 1h);
    EXPECT_EQ(a.outcome.get(), "run");
    EXPECT_FALSE(queue.submit(b.job()));
    EXPECT_EQ(b.outcome.get(), "closed");
  }
  EXPECT_EQ(ended, ran);
}

TEST(JobQueue, DropsTheRestAfterTheGrace) {
  std::list<Watched> others; // outlive the queue, which may hold some of them
  Watched first, second;
  std::promise<void> running, closed;
  JobQueue queue(4);
  EXPECT_FALSE(queue.submit(first.job([&] {
    running.set_value();
    closed.get_future().wait();
  })));
  EXPECT_FALSE(queue.submit(second.job()));
  running.get_future().wait();
  std::thread closing([&] { queue.close(Clock::now()); });
  // The first job runs on until the queue is known to be closed: a further one is dropped at the door.
  do {
    std::this_thread::yield();
    others.emplace_back();
  } while (queue.submit(others.back().job()) || others.back().outcome.wait_for(0s) != std::future_status::ready);
  closed.set_value();
  closing.join();
  EXPECT_EQ(first.outcome.get(), "run");
  EXPECT_EQ(second.outcome.get(), "closed");
}

TEST(JobQueue, EstimatesWhenToComeAgain) {
  EXPECT_EQ(retryAfterSeconds(0, 10), 1);
  EXPECT_EQ(retryAfterSeconds(500, 3), 2);
  EXPECT_EQ(retryAfterSeconds(100'000, 100), 60);
}

} // namespace
} // namespace gnomon
