// What a queue in one process meets: a clock that is set, and a disk that refuses.
#include "server/jobs/local_jobs.h"

#include <cerrno>
#include <csignal>
#include <ctime>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tests/server/jobs/tested_queue.h"

namespace {

std::atomic<std::int64_t> setForward{0}; ///< seconds

} // namespace

/// In the place of libc's: the time of day may be set.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const auto result = static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  if (result == 0 && clock == CLOCK_REALTIME) time->tv_sec += setForward;
  return result;
}

namespace gnomon {
namespace {

using namespace std::chrono_literals;

/// The job's one frame is drawn.
void draw(LocalJobs& jobs, const std::string& job) {
  ASSERT_TRUE(jobs.put(jobOfFrames(job, 1)));
  const auto turn = jobs.take(5s);
  ASSERT_TRUE(turn && *turn);
  ASSERT_TRUE(jobs.finish(**turn, drawnFrame("picture")));
}

JobProgress progressOf(LocalJobs& jobs, const std::string& job) {
  const auto found = jobs.find(job);
  EXPECT_TRUE(found && *found);
  return found && *found ? **found : JobProgress();
}

TEST(LocalJobs, AClockThatIsSetForwardEndsNoJobsAge) {
  LocalJobs jobs({.age = 24h}, "");
  draw(jobs, "done");
  const std::int64_t before = unixMilliseconds();
  setForward = 2 * 86'400;
  ASSERT_GT(unixMilliseconds(), before + 86'400'000) << "the clock was set";
  EXPECT_TRUE(*jobs.find("done"));
  EXPECT_TRUE(*jobs.frame("done", 0));
  setForward = 0;
}

TEST(LocalJobs, AJobIsRefusedWhereTheDiskGivesNoFile) {
  LocalJobs jobs({}, "/nonexistent");
  const Status put = jobs.put(jobOfFrames("a", 1));
  ASSERT_FALSE(put);
  EXPECT_EQ(put.problems().front().code, ProblemCode::unavailable);
  EXPECT_FALSE(*jobs.find("a"));
}

TEST(LocalJobs, AJobWhosePicturesTheDiskRefusesSaysSo) {
  LocalJobs jobs({}, "");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ::getrlimit(RLIMIT_FSIZE, &usual);
  const rlimit none{0, usual.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &none);
  draw(jobs, "a");
  ::setrlimit(RLIMIT_FSIZE, &usual);
  const JobProgress progress = progressOf(jobs, "a");
  EXPECT_EQ(progress.state, JobState::failed);
  ASSERT_EQ(progress.problems.size(), 1u);
  EXPECT_EQ(progress.problems.front().code, ProblemCode::internal);
  EXPECT_EQ(progress.problems.front().detail.find("--job-bytes"), std::string::npos) << "that bound was not met";
}

TEST(ResultFile, SaysWhetherADiskIsFull) {
  for (const int reason : {ENOSPC, EDQUOT, ENOMEM}) {
    EXPECT_EQ(refusedByDisk(reason, ProblemCode::internal).code, ProblemCode::insufficientStorage);
  }
  for (const int reason : {EROFS, EIO, EACCES}) {
    EXPECT_EQ(refusedByDisk(reason, ProblemCode::internal).code, ProblemCode::internal);
  }
}

} // namespace
} // namespace gnomon
