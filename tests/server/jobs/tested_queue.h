#pragma once

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

} // namespace gnomon
