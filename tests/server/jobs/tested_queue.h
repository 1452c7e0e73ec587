#pragma once

#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "protocol/base/bytes.h"
#include "server/jobs/job_queue.h"

namespace gnomon {

/// A queue that the suite runs over. Every call of `open` gives the queue of another process, where it can be shared.
struct TestedQueue {
  std::string name;
  bool isShared = false;
  std::function<void()> clear;                                     ///< before each test
  std::function<std::unique_ptr<JobQueue>(const JobLimits&)> open; ///< nullptr = what it needs is not installed
};

inline std::ostream& operator<<(std::ostream& stream, const TestedQueue& queue) {
  return stream << queue.name;
}

/// In memory, in a directory, and in a Redis of the test's own.
std::vector<TestedQueue> testedQueues();

/// A job of `count` frames.
inline NewJob jobOfFrames(const std::string& id, int count, const std::string& client = "ann") {
  return {.id = id, .key = client, .client = {client, client}, .scene = "scene", .request = "{}", .count = count};
}

/// The content key of drawnFrame(picture).
inline std::string contentKeyOf(const std::string& picture) {
  Sha256 hash;
  hash.add(picture);
  return hash.hex();
}

/// What a frame might look like.
inline JobFrame drawnFrame(const std::string& picture, Carried carried = {}) {
  const std::vector<PictureNews> pictures{{"color", "image/png", picture.size()}};
  return {.note = {.contentKey = contentKeyOf(picture),
                   .carried = std::move(carried),
                   .warnings = {"a warning"},
                   .stages = {{"shade", 1.5}},
                   .milliseconds = 2.5,
                   .pictures = pictures},
          .pictures = *FramePictures::of(pictures, picture)};
}

/// A test over each of them, in a queue that is empty.
class JobQueueTest : public ::testing::TestWithParam<TestedQueue> {
 protected:
  void SetUp() override {
    GetParam().clear();
    open({});
  }

  void open(const JobLimits& limits) {
    limits_ = limits;
    queue_ = GetParam().open(limits);
    if (!queue_) GTEST_SKIP() << "redis-server is not installed.";
  }

  void put(const NewJob& job) { ASSERT_TRUE(queue_->put(job)); }

  /// A frame that must be there.
  FrameTurn take() {
    auto turn = queue_->take(std::chrono::seconds(5));
    EXPECT_TRUE(turn && *turn);
    return turn && *turn ? **turn : FrameTurn();
  }
  bool isIdle() {
    const auto turn = queue_->take(std::chrono::milliseconds(0));
    return turn && !*turn;
  }
  void finish(const FrameTurn& turn) {
    ASSERT_TRUE(queue_->finish(turn, drawnFrame(turn.job + std::to_string(turn.index))));
  }
  JobProgress progress(const std::string& job) {
    const auto found = queue_->find(job);
    EXPECT_TRUE(found && *found);
    return found && *found ? **found : JobProgress();
  }
  std::string picture(const std::string& job, int index) {
    const auto found = queue_->frame(job, index);
    EXPECT_TRUE(found);
    return found && *found ? std::string((*found)->pictures.bytes()) : "none";
  }

  JobLimits limits_;
  std::unique_ptr<JobQueue> queue_;
};

} // namespace gnomon
