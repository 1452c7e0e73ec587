#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <semaphore>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/spec/frame_spec.h"
#include "server/dispatch/task.h"
#include "server/handlers/handlers.h"
#include "server/handlers/outcome_reply.h"

/// How handlers have workers do the work.
namespace gnomon {

/// Seconds of "wait=SECONDS" in a Prefer header (RFC 7240); nothing where there is none.
std::optional<int> preferredWait(const HttpRequest& request);

/// Whether a Prefer header has "respond-async".
bool prefersAsync(const HttpRequest& request);

/// A task for the scene of a bundle, which ends `timeout` after the request's first byte, or earlier where the client's
/// Prefer: wait=SECONDS (RFC 7240) says so.
Task taskFor(const RouteCall& call, OrderKind kind, std::string sceneId, StoredBundle bundle, std::string request,
             std::chrono::milliseconds timeout);

/// An estimate of a frame's time counts work that it may be spared, and may be wrong by as much as this.
inline constexpr double kDoubt = 4;

/// "12 seconds", for problems that quote a time; rounded up.
std::string secondsText(double milliseconds);

/// Frames that are expected to take longer wait for each other, and leave a worker to all others.
inline constexpr double kLongFrame = 1'000; ///< milliseconds

/// The task of drawing a frame, in the lane that its cost asks for. Where it is expected to take longer than a request
/// may, the problem says so (RefusalReason::cost); what meets a target is found within the time of an evaluation.
Result<Task> frameTask(const Services& services, const RouteCall& call, const std::string& scene, StoredBundle bundle,
                       const FrameSpec& spec, const SceneCounts& counts);

/// Takes room for the body of a result. Where there is none by the deadline, or it is not wanted any more, the body is
/// let go and the result is the problem of noReplyRoom().
void takeRoom(TaskResult& result, ByteBudget& budget, const Holder& holder, Clock::time_point deadline,
              const std::function<bool()>& unwanted);

/// Runs the task on this thread's behalf. A bundle that a worker calls damaged, and that is, is set aside, and becomes
/// a notFound problem. The body has room, but that of a sequence's frame, for which its sequence takes it
/// (SequenceFrames).
TaskResult runTask(Services& services, Task task, const std::function<bool()>& gone, const TaskEvents& events = {});

/// Has a worker load the scene: its summary, or the reply that says why not. `strict`: refused where it violates glTF.
HttpReply loadScene(Services& services, const RouteCall& call, const std::string& id, StoredBundle bundle,
                    bool strict = false);

/// Does the work. `gone`: its result is not wanted any more. `events`: takes its events.
using EventedWork = std::function<TaskResult(const std::function<bool()>& gone, const TaskEvents& events)>;

/// The result of the work as `mediaType`: where that is kEventStream, events are sent while it is done, and problems
/// become one of them.
HttpReply replyAs(std::string_view mediaType, const RouteCall& call, EventedWork work);

/// One of a few permits, given back when the last copy goes; null where all are taken.
using Permit = std::shared_ptr<std::counting_semaphore<>>;
Permit permitOf(std::counting_semaphore<>& permits);

} // namespace gnomon
