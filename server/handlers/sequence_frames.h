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
#include "protocol/sequence/sequence.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/system/byte_budget.h"
#include "server/wire/frame_pictures.h"

namespace gnomon {

/// A frame of a sequence, or why there is none.
struct DoneFrame {
  int index = 0;
  Problems problems{};               ///< with places in the request
  TaskResult result{};               ///< where there are problems: what refused
  FramePictures pictures{};          ///< none where there are problems
  std::unique_ptr<ByteLease> room{}; ///< for their bytes, beside all replies that clients are taking
  Carried own{};                     ///< of this frame alone
  Carried carried{};                 ///< for the next frame
  std::vector<std::string> warnings{};
  double milliseconds = 0; ///< since its beginning
};

/// A frame that is to be drawn.
struct FrameToDraw {
  const Sequence& sequence;
  int index = 0;
  Carried before{}; ///< what it takes from the frame before it
  SceneCounts counts{};
  Task task{};            ///< all but the frame's own; its deadline is that of all frames
  bool isPatient = false; ///< asks again where too many tasks wait
  std::function<bool()> gone;
  std::function<void(const DoneFrame&)> drawn{}; ///< called with what it carries, once the next one can begin

  // Room for its bytes; absent = they need none
  std::function<bool()> awaitRoom{};                 ///< before it is drawn; false = there will be none
  std::function<bool(std::size_t bytes)> takeRoom{}; ///< before its bytes are read; false = it is drawn again
};

/// Problems of a frame's own spec, seen from the request.
Problems placed(Problems problems, const std::string& place);

/// Has a worker draw it, on the calling thread's behalf.
DoneFrame drawSequenceFrame(Services& services, FrameToDraw call);

/// Frames of a sequence, in order, as a reply sends them.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual bool atEnd() const = 0;
  virtual int count() const = 0; ///< of the whole sequence

  /// What the next frame waits for without a thread; nullptr = next() has it, or waits itself. `heartbeat`: of that
  /// wait.
  virtual std::shared_ptr<ReplyWait> wait(std::string_view /*heartbeat*/) { return nullptr; }

  /// The next frame. `waiting` is called every few seconds until it is there. After one with problems there is none.
  /// REQUIRES: not atEnd().
  virtual DoneFrame next(const std::function<void()>& waiting) = 0;
};

/// Has workers draw the frames of a sequence, each as a task of its own, at most two at once: a frame begins once the
/// one before it is drawn, while that is encoded and sent. A slow reader delays later frames: one frame is rendered
/// ahead. A frame for whose bytes there is no room is dropped, and drawn again once there is: only the first one gives
/// up.
class SequenceFrames final : public FrameSource {
 public:
  /// `task`: what every frame's task begins with; its deadline is that of the whole sequence. `permit` is held as long
  /// as this lives.
  SequenceFrames(Services& services, Sequence sequence, SceneCounts counts, Task task, Permit permit,
                 std::function<bool()> clientGone);
  ~SequenceFrames() override; ///< stops what is in work, and waits for it

  bool atEnd() const override { return inWork_.empty() && next_ == sequence_.count; }
  int count() const override { return sequence_.count; }
  DoneFrame next(const std::function<void()>& waiting) override;

 private:
  struct FrameInWork {
    DoneFrame frame;
    std::unique_ptr<ByteLease> room;
    std::size_t expected = 0; ///< bytes for which there has to be room before it is drawn
    bool isDrawn = false;
    bool lacksRoom = false; ///< it was dropped, and waits
    bool isDone = false;
    std::thread thread; ///< none where the system refused it
  };

  void begin();
  void work(FrameInWork& inWork, FrameToDraw call);
  void end(FrameInWork& inWork, DoneFrame frame);
  bool awaitRoom(FrameInWork& inWork);
  bool takeRoom(FrameInWork& inWork, std::size_t bytes);
  bool isNext(const FrameInWork& inWork) const;
  bool gone() const { return stopped_ || clientGone_(); }
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
