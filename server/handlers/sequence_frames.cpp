#include "server/handlers/sequence_frames.h"

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/carry.h"
#include "server/system/memory_file.h"

namespace gnomon {
namespace {

constexpr std::size_t kInWork = 2; ///< one is drawn, one is encoded

/// Problems of a frame's own spec, seen from the request.
Problems placed(Problems problems, const std::string& place) {
  for (Problem& problem : problems) {
    const bool isPlace = problem.pointer.empty() || problem.pointer.front() == '/';
    if (isPlace) problem.pointer.insert(0, place);
  }
  return problems;
}

std::size_t bytesOf(const std::vector<PictureNews>& pictures) {
  std::size_t bytes = 0;
  for (const PictureNews& picture : pictures) bytes += picture.bytes;
  return bytes;
}

} // namespace

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
  const ByteBudget& budget = services_.replyBytes; // ahead of its time only where its bytes are likely to find room
  return expected_ > 0 && budget.used() + 2 * expected_ <= budget.total();
}

void SequenceFrames::begin() {
  const Carried before = inWork_.empty() ? carried_ : inWork_.back()->frame.carried;
  const FrameSpec spec = frameSpec(sequence_, next_, before);
  Task task = task_;
  task.request = jsonText(toJson(spec));
  task.allowed = services_.requestTimeout;
  task.needsDriver = needsDriver(spec);
  task.holdsRenderer = services_.workers.milliseconds(frameCost(spec, counts_)) > kLongFrame;
  auto inWork = std::make_unique<FrameInWork>();
  inWork->frame.index = next_++;
  inWork->frame.carried = before;
  inWork->frame.room = std::make_unique<ByteLease>(services_.replyBytes);
  const std::size_t expected = inWork_.empty() ? expected_ : 0;
  inWork_.push_back(std::move(inWork));
  FrameInWork& begun = *inWork_.back();
  try {
    begun.thread = std::thread(
        [this, &begun, expected, task = std::move(task)]() mutable { work(begun, std::move(task), expected); });
  } catch (const std::system_error&) {
    end(begun, {{ProblemCode::unavailable, "", "The system has no thread left for a frame of the sequence.", "", ""}});
  }
}

/// With the mutex held.
void SequenceFrames::end(FrameInWork& inWork, Problems problems) {
  inWork.frame.problems = placed(std::move(problems), framePlace(sequence_, inWork.frame.index));
  inWork.isDone = true;
  changed_.notify_all();
}

/// A frame's thread.
void SequenceFrames::work(FrameInWork& inWork, Task task, std::size_t expected) {
  const auto start = Clock::now();
  Problems problems;
  TaskResult result;
  Bytes bytes;
  try {
    if (task.request.size() > kLimits.maxSpecBytes) {
      problems = {{ProblemCode::tooLarge, "", "The frame's spec is too large with every default filled in.",
                   std::to_string(kLimits.maxSpecBytes) + " bytes", std::to_string(task.request.size()) + " bytes"}};
    } else {
      result = runWithRoom(inWork, task, expected);
      problems = std::move(result.outcome.problems);
    }
    const std::size_t size = bytesOf(inWork.frame.pictures);
    std::optional<Bytes> read;
    if (problems.empty() && result.body) read = readFile(*std::exchange(result.body, std::nullopt), size);
    if (problems.empty() && (!read || read->size() != size || size == 0)) {
      problems = {{ProblemCode::internal, "", "The worker's reply could not be read.", "", ""}};
    }
    bytes = std::move(read).value_or(Bytes());
  } catch (const std::exception&) {
    problems = {{ProblemCode::internal, "", "An internal error occurred.", "", ""}};
  }
  const std::lock_guard lock(mutex_);
  inWork.frame.result = std::move(result);
  inWork.frame.bytes = std::move(bytes);
  inWork.frame.milliseconds = millisecondsSince(start);
  expected_ = std::max(expected_, inWork.frame.bytes.size());
  end(inWork, std::move(problems));
}

/// Whatever waits for room holds nothing meanwhile, so that no two sequences wait for each other.
TaskResult SequenceFrames::runWithRoom(FrameInWork& inWork, Task& task, std::size_t expected) {
  while (true) {
    if (!awaitRoom(inWork, expected)) {
      TaskResult refused;
      refused.refusal = TaskRefusal::memory;
      refused.outcome.problems = {noReplyRoom()};
      return refused;
    }
    task.deadline = std::min(task_.deadline, Clock::now() + services_.requestTimeout);
    TaskResult result = runPatiently(inWork, task);
    if (!result.outcome.problems.empty()) return result;
    const std::size_t bytes = bytesOf(inWork.frame.pictures);
    if (takeRoom(inWork, bytes)) return result;
    expected = bytes;
  }
}

/// Whether all frames before it are done. With the mutex held.
bool SequenceFrames::isNext(const FrameInWork& inWork) const {
  const FrameInWork& first = *inWork_.front();
  return &first == &inWork || first.isDone;
}

bool SequenceFrames::awaitRoom(FrameInWork& inWork, std::size_t bytes) {
  if (bytes == 0) return true;
  const bool isFirst = inWork.frame.index == sequence_.first;
  const auto deadline = isFirst ? Clock::now() + services_.replyRoom : task_.deadline;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return isNext(inWork); });
  lock.unlock();
  const std::size_t needed = std::min(bytes, services_.replyBytes.total());
  if (!inWork.frame.room->growBy(needed, deadline, [this] { return gone(); })) return false;
  lock.lock();
  inWork.lacksRoom = false;
  return true;
}

/// For what the frame has come to: now or not at all, and never before the frames before it have theirs.
bool SequenceFrames::takeRoom(FrameInWork& inWork, std::size_t bytes) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return isNext(inWork) || inWork_.front()->lacksRoom; });
  ByteLease& room = *inWork.frame.room;
  const std::size_t needed = std::min(bytes, services_.replyBytes.total());
  const bool isTaken = isNext(inWork) && (needed <= room.held() || room.grow(needed - room.held()));
  room.shrinkTo(isTaken ? needed : 0);
  inWork.lacksRoom = !isTaken;
  changed_.notify_all();
  return isTaken;
}

/// A full queue ends no sequence that has begun: its frame asks again until its deadline.
TaskResult SequenceFrames::runPatiently(FrameInWork& inWork, const Task& task) {
  constexpr std::chrono::milliseconds kPause{50};
  const auto isGone = [this] { return gone(); };
  while (true) {
    TaskResult result = runTask(services_, task, isGone, [&](const OrderEvent& event) { hear(inWork, event); });
    const bool isFirst = inWork.frame.index == sequence_.first;
    if (result.refusal != TaskRefusal::queue || isFirst || gone() || Clock::now() >= task.deadline) return result;
    std::this_thread::sleep_for(kPause);
  }
}

void SequenceFrames::hear(FrameInWork& inWork, const OrderEvent& event) {
  auto news = event.name == kSequenceNews ? readSequenceNews(event.data) : std::nullopt;
  if (!news) return;
  const std::lock_guard lock(mutex_);
  if (news->drawn && !inWork.isDrawn) {
    inWork.frame.carried = carriedAfter(inWork.frame.carried, std::move(news->drawn->carried));
    inWork.frame.warnings = std::move(news->drawn->warnings);
    inWork.isDrawn = true;
    changed_.notify_all();
  }
  if (!news->pictures.empty()) inWork.frame.pictures = std::move(news->pictures);
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
