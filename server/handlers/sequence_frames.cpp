#include "server/handlers/sequence_frames.h"

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/sequence.h"
#include "server/system/no_thread.h"

namespace gnomon {
namespace {

Task taskOfFrame(Services& services, const FrameToDraw& call) {
  FrameSpec spec = frameSpec(call.sequence, call.index, call.before);
  if (call.task.order.mediaType == kRawVideo) spec = videoFrame(std::move(spec));
  Task task = call.task;
  task.request = jsonText(toJson(spec));
  task.allowed = services.requestTimeout;
  task.holdsRenderer = services.workers.milliseconds(spec, call.counts) > kLongFrame;
  return task;
}

/// A full queue ends no sequence that has begun, nor does what other requests of its client did to workers: its frame
/// asks again until its deadline.
TaskResult runPatiently(Services& services, const FrameToDraw& call, const Task& task, const TaskEvents& events) {
  constexpr std::chrono::milliseconds kPause{50};
  while (true) {
    TaskResult result = runTask(services, task, call.gone, events);
    const bool mayPass = result.refusal == TaskRefusal::queue || result.refusal == TaskRefusal::client;
    if (!mayPass || !call.isPatient || call.gone() || Clock::now() >= task.deadline) {
      return result;
    }
    std::this_thread::sleep_for(kPause);
  }
}

Problems draw(Services& services, const FrameToDraw& call, DoneFrame& frame) {
  Task task = taskOfFrame(services, call);
  if (task.request.size() > kLimits.maxSpecBytes) {
    return {{ProblemCode::tooLarge, "", "The frame's spec is too large with every default filled in.",
             std::to_string(kLimits.maxSpecBytes) + " bytes", std::to_string(task.request.size()) + " bytes"}};
  }
  bool isDrawn = false;
  std::vector<PictureNews> pictures;
  const auto onEvent = [&](const OrderEvent& event) {
    auto news = readSequenceNews(event.data);
    if (!news) return;
    if (news->drawn && !isDrawn) {
      isDrawn = true;
      frame.own = std::move(news->drawn->carried);
      frame.carried = carriedAfter(call.before, frame.own);
      frame.warnings = std::move(news->drawn->warnings);
      if (call.drawn) call.drawn(frame);
    }
    if (!news->pictures.empty()) pictures = std::move(news->pictures);
  };
  while (true) {
    if (call.awaitRoom && !call.awaitRoom()) {
      frame.result.refusal = TaskRefusal::memory;
      frame.result.outcome.retryAfterSeconds = services.replyBytes.retryAfterSeconds();
      return {noReplyRoom()};
    }
    task.deadline = std::min(call.task.deadline, Clock::now() + services.requestTimeout);
    frame.result = runPatiently(services, call, task, onEvent);
    if (!frame.result.outcome.problems.empty()) return std::move(frame.result.outcome.problems);
    if (!call.takeRoom || call.takeRoom(bytesOf(pictures).value_or(0))) break;
  }
  auto made =
      FramePictures::of(std::move(pictures), std::exchange(frame.result.body, std::nullopt).value_or(SharedBytes()));
  if (!made) return std::move(made).problems();
  frame.pictures = *std::move(made);
  return {};
}

constexpr std::size_t kInWork = 2; ///< one is drawn, one is encoded

} // namespace

Problems placed(Problems problems, const std::string& place) {
  for (Problem& problem : problems) {
    const bool isPlace = problem.pointer.empty() || problem.pointer.front() == '/';
    if (isPlace) problem.pointer.insert(0, place);
  }
  return problems;
}

DoneFrame drawSequenceFrame(Services& services, FrameToDraw call) {
  const auto start = Clock::now();
  DoneFrame frame{.index = call.index, .carried = call.before};
  try {
    frame.problems = placed(draw(services, call, frame), framePlace(call.sequence, call.index));
  } catch (const std::exception&) {
    frame.problems = {{ProblemCode::internal, "", "An internal error occurred.", "", ""}};
  }
  frame.milliseconds = millisecondsSince(start);
  return frame;
}

SequenceFrames::SequenceFrames(Services& services, Sequence sequence, SceneCounts counts, Task task, Permit permit,
                               std::function<bool()> clientGone)
    : services_(services),
      sequence_(std::move(sequence)),
      counts_(std::move(counts)),
      task_(std::move(task)),
      permit_(std::move(permit)),
      clientGone_(std::move(clientGone)),
      next_(sequence_.first),
      carried_(sequence_.carried) {}

SequenceFrames::~SequenceFrames() {
  stopped_ = true;
  for (const auto& inWork : inWork_) {
    if (inWork->thread.joinable()) inWork->thread.join();
  }
}

/// With the mutex held.
bool SequenceFrames::mayBegin() const {
  if (next_ == sequence_.count || inWork_.size() >= kInWork) return false;
  if (inWork_.empty()) return true;
  const FrameInWork& before = *inWork_.back();
  if (!before.isDrawn || before.lacksRoom || !before.frame.problems.empty()) return false;
  // Ahead of its time only where its bytes are likely to find room.
  return expected_ > 0 && services_.replyBytes.hasRoom(task_.holder, 2 * expected_);
}

void SequenceFrames::begin() {
  FrameToDraw call{.sequence = sequence_,
                   .index = next_++,
                   .before = inWork_.empty() ? carried_ : inWork_.back()->frame.carried,
                   .counts = counts_,
                   .task = task_,
                   .gone = [this] { return gone(); }};
  call.isPatient = call.index != sequence_.first;
  auto inWork = std::make_unique<FrameInWork>();
  inWork->frame.index = call.index;
  inWork->frame.carried = call.before;
  inWork->room = std::make_unique<ByteLease>(services_.replyBytes, task_.holder);
  inWork->expected = inWork_.empty() ? expected_ : 0;
  inWork_.push_back(std::move(inWork));
  FrameInWork& begun = *inWork_.back();
  try {
    begun.thread = std::thread([this, &begun, call]() mutable { work(begun, std::move(call)); });
  } catch (const std::system_error&) {
    end(begun, {.index = call.index,
                .problems = placed({noThreadFor("a frame of the sequence")}, framePlace(sequence_, call.index)),
                .carried = call.before});
  }
}

/// With the mutex held.
void SequenceFrames::end(FrameInWork& inWork, DoneFrame frame) {
  inWork.frame = std::move(frame);
  inWork.frame.room = std::move(inWork.room);
  inWork.isDone = true;
  changed_.notify_all();
}

/// A frame's thread.
void SequenceFrames::work(FrameInWork& inWork, FrameToDraw call) {
  call.drawn = [&](const DoneFrame& drawn) {
    const std::lock_guard lock(mutex_);
    inWork.frame.carried = drawn.carried;
    inWork.isDrawn = true;
    changed_.notify_all();
  };
  call.awaitRoom = [&] { return awaitRoom(inWork); };
  call.takeRoom = [&](std::size_t bytes) {
    inWork.expected = bytes;
    return takeRoom(inWork, bytes);
  };
  DoneFrame frame = drawSequenceFrame(services_, std::move(call));
  const std::lock_guard lock(mutex_);
  expected_ = std::max(expected_, frame.pictures.bytes().size());
  end(inWork, std::move(frame));
}

/// Whether all frames before it are done. With the mutex held.
bool SequenceFrames::isNext(const FrameInWork& inWork) const {
  const FrameInWork& first = *inWork_.front();
  return &first == &inWork || first.isDone;
}

/// A waiting sequence holds no room meanwhile, so that no two sequences wait for each other.
bool SequenceFrames::awaitRoom(FrameInWork& inWork) {
  if (inWork.expected == 0) return true;
  const bool isFirst = inWork.frame.index == sequence_.first;
  const auto deadline = isFirst ? Clock::now() + services_.replyRoom : task_.deadline;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return isNext(inWork); });
  lock.unlock();
  const std::size_t needed = std::min(inWork.expected, services_.replyBytes.total());
  if (!inWork.room->growBy(needed, deadline, [this] { return gone(); })) return false;
  lock.lock();
  inWork.lacksRoom = false;
  return true;
}

/// For what the frame has come to: now or not at all, and never before the frames before it have theirs.
bool SequenceFrames::takeRoom(FrameInWork& inWork, std::size_t bytes) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return isNext(inWork) || inWork_.front()->lacksRoom; });
  ByteLease& room = *inWork.room;
  const std::size_t needed = std::min(bytes, services_.replyBytes.total());
  const bool isTaken = isNext(inWork) && (needed <= room.held() || room.grow(needed - room.held()));
  room.shrinkTo(isTaken ? needed : 0);
  inWork.lacksRoom = !isTaken;
  changed_.notify_all();
  return isTaken;
}

DoneFrame SequenceFrames::next(const std::function<void()>& waiting) {
  constexpr std::chrono::milliseconds kHeartbeat{5'000};
  std::unique_lock lock(mutex_);
  while (true) {
    if (mayBegin()) begin();
    const bool inTime = changed_.wait_for(lock, kHeartbeat, [&] { return inWork_.front()->isDone || mayBegin(); });
    if (inWork_.front()->isDone && !mayBegin()) break;
    if (inTime) continue;
    lock.unlock();
    waiting();
    lock.lock();
  }
  const auto inWork = std::move(inWork_.front());
  inWork_.pop_front();
  carried_ = inWork->frame.carried;
  lock.unlock();
  if (inWork->thread.joinable()) inWork->thread.join();
  return std::move(inWork->frame);
}

} // namespace gnomon
