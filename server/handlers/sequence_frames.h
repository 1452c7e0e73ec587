#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "protocol/cost/frame_cost.h"
#include "protocol/sequence/sequence_json.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/wire/sequence_news.h"

namespace gnomon {

/// A frame of a sequence, or why there is none.
struct DoneFrame {
  int index = 0;
  Problems problems{}; ///< with places in the request
  TaskResult result{}; ///< where there are problems: who refused
  std::vector<PictureNews> pictures{};
  Bytes bytes{};                     ///< of the pictures, one after the other
  std::unique_ptr<ByteLease> room{}; ///< for the bytes, beside all replies that clients are taking
  Carried carried{};                 ///< for the next frame
  std::vector<std::string> warnings{};
  double milliseconds = 0; ///< since its beginning
};

/// Has workers draw the frames of a sequence, each as a task of its own, at most two at once: a frame begins once the
/// one before it is drawn, while that is encoded and sent. Who takes frames slowly holds up the frames after the next.
/// A frame for whose bytes there is no room is dropped, and drawn again once there is: only the first one gives up.
class SequenceFrames {
 public:
  /// `task`: what every frame's task begins with; its deadline is that of the whole sequence. `permit` is held as long
  /// as this lives.
  SequenceFrames(Services& services, Sequence sequence, SceneCounts counts, Task task, Permit permit,
                 std::function<bool()> clientGone);
  ~SequenceFrames(); ///< stops what is in work, and waits for it
  SequenceFrames(const SequenceFrames&) = delete;
  SequenceFrames& operator=(const SequenceFrames&) = delete;

  bool atEnd() const { return inWork_.empty() && next_ == sequence_.count; }
  int count() const { return sequence_.count; }

  /// The next frame. `waiting` is called every few seconds until it is there. After one with problems there is none.
  /// REQUIRES: not atEnd().
  DoneFrame next(const std::function<void()>& waiting);

 private:
  struct FrameInWork {
    DoneFrame frame;
    bool isDrawn = false;
    bool lacksRoom = false; ///< it was dropped, and waits
    bool isDone = false;
    std::thread thread; ///< none where the system refused it
  };

  void begin();
  void work(FrameInWork& inWork, Task task, std::size_t expected);
  void end(FrameInWork& inWork, Problems problems);
  TaskResult runWithRoom(FrameInWork& inWork, Task& task, std::size_t expected);
  bool awaitRoom(FrameInWork& inWork, std::size_t bytes);
  bool takeRoom(FrameInWork& inWork, std::size_t bytes);
  bool isNext(const FrameInWork& inWork) const;
  bool gone() const { return stopped_ || clientGone_(); }
  TaskResult runPatiently(FrameInWork& inWork, const Task& task);
  void hear(FrameInWork& inWork, const OrderEvent& event);
  bool mayBegin() const;

  Services& services_;
  const Sequence sequence_;
  const SceneCounts counts_;
  const Task task_;
  const Permit permit_;
  const std::function<bool()> clientGone_;
  std::atomic<bool> stopped_ = false;
  int next_;                 ///< the frame that begins next
  Carried carried_;          ///< of the last frame that was taken
  std::size_t expected_ = 0; ///< bytes of the largest frame so far
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::unique_ptr<FrameInWork>> inWork_; ///< each frame's members are guarded by the mutex
};

} // namespace gnomon
