#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/http/reply.h"
#include "server/system/clock.h"

namespace gnomon {

/// Frames in progress by entity tag: a request for one that is being drawn waits for it, instead of having it drawn
/// again. Any thread.
class SharedFrames {
 public:
  using Gone = std::function<bool()>;

  /// The reply of `draw`, or of another call's with the same tag. `draw` is given what says whether any
  /// caller still waits, this one or one that joined. A reply that is not 200 is this caller's alone, as is what `draw`
  /// throws: a caller that waited for it calls its own `draw`. `gone` is asked some fifty times a second; once it is
  /// true, or the deadline has passed, `draw` is called at once, and reports why it fails.
  HttpReply run(const std::string& etag, Clock::time_point deadline, const Gone& gone,
                const std::function<HttpReply(const Gone&)>& draw);

  /// Replies that were drawn for another call, since the start.
  std::uint64_t shared() const { return shared_; }

  /// Calls that wait for what is being drawn for another, now.
  int waiting() const;

 private:
  struct Flight {
    int joined = 0;
    bool done = false;
    std::shared_ptr<const HttpReply> reply; ///< where it is of use to others
    std::condition_variable changed;
  };

  std::shared_ptr<const HttpReply> await(const std::shared_ptr<Flight>& flight, Clock::time_point deadline,
                                         const Gone& gone, std::unique_lock<std::mutex>& lock);

  std::atomic<std::uint64_t> shared_{0};
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Flight>> flights_;
};

} // namespace gnomon
