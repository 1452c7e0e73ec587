#include "server/handlers/sequence_frame.h"

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/carry.h"
#include "protocol/sequence/video_frames.h"
#include "server/system/memory_file.h"

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

/// A full queue ends no sequence that has begun: its frame asks again until its deadline.
TaskResult runPatiently(Services& services, const FrameToDraw& call, const Task& task, const TaskEvents& events) {
  constexpr std::chrono::milliseconds kPause{50};
  while (true) {
    TaskResult result = runTask(services, task, call.gone, events);
    if (result.refusal != TaskRefusal::queue || !call.isPatient || call.gone() || Clock::now() >= task.deadline) {
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
  const auto onEvent = [&](const OrderEvent& event) {
    auto news = event.name == kSequenceNews ? readSequenceNews(event.data) : std::nullopt;
    if (!news) return;
    if (news->drawn && !isDrawn) {
      isDrawn = true;
      frame.own = std::move(news->drawn->carried);
      frame.carried = carriedAfter(call.before, frame.own);
      frame.warnings = std::move(news->drawn->warnings);
      if (call.drawn) call.drawn(frame);
    }
    if (!news->pictures.empty()) frame.pictures = std::move(news->pictures);
  };
  while (true) {
    if (call.awaitRoom && !call.awaitRoom()) {
      frame.result.refusal = TaskRefusal::memory;
      return {noReplyRoom()};
    }
    task.deadline = std::min(call.task.deadline, Clock::now() + services.requestTimeout);
    frame.result = runPatiently(services, call, task, onEvent);
    if (!frame.result.outcome.problems.empty()) return std::move(frame.result.outcome.problems);
    if (!call.takeRoom || call.takeRoom(bytesOf(frame.pictures))) break;
  }
  const std::size_t size = bytesOf(frame.pictures);
  std::optional<Bytes> read;
  if (frame.result.body) read = readFile(*std::exchange(frame.result.body, std::nullopt), size);
  if (!read || read->size() != size || size == 0) {
    return {{ProblemCode::internal, "", "The worker's reply could not be read.", "", ""}};
  }
  frame.bytes = *std::move(read);
  return {};
}

} // namespace

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

} // namespace gnomon
