#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/cost/frame_cost.h"
#include "server/system/byte_budget.h"
#include "server/system/client_identity.h"
#include "server/system/clock.h"
#include "server/system/file_descriptor.h"
#include "server/system/shared_bytes.h"
#include "server/wire/messages.h"

namespace gnomon {

/// Tasks of one lane never stand before those of another.
enum class Lane {
  interactive, ///< a client waits for it
  batch,       ///< may take minutes
  load,        ///< scenes that are uploaded
  sequence     ///< frames of sequences
};
inline constexpr std::size_t kLanes = 4;
inline constexpr std::array<std::string_view, kLanes> kLaneNames{"interactive", "batch", "load", "sequence"};

/// Work for a worker.
struct Task {
  Order order; ///< its number and times are filled in when it is sent
  std::shared_ptr<const FileDescriptor> bundle;
  std::string request; ///< JSON
  Clock::time_point deadline;
  std::chrono::milliseconds
      allowed{}; ///< from the request's first byte to the deadline, for the problem that quotes it
  Lane lane = Lane::interactive;
  bool holdsRenderer = false; ///< draws for so long that others of its worker would wait
  std::optional<FrameCost>
      cost{};                ///< of a frame that has the whole time of a request: its end teaches what frames take
  ClientIdentity client{};   ///< tasks of different sites take turns, and in each of them those of its clients
  Holder holder{};           ///< of the room for the result's body
  std::string affinityKey{}; ///< tasks whose scenes have much in common; they prefer one worker. Empty = the scene's id
};

/// Why the dispatcher itself refused a task.
enum class TaskRefusal {
  none,
  queue,  ///< too many wait
  memory, ///< there is too little for it
  client  ///< its client's tasks ended too many workers
};

/// What became of a task.
struct TaskResult {
  Outcome outcome;
  std::optional<SharedBytes> body{}; ///< where there are no problems
  TaskRefusal refusal = TaskRefusal::none;
  ReplyRoom room{}; ///< for the body, once it may be read as a reply
};

/// Takes a task's events, in order, on the thread that waits for the task.
using TaskEvents = std::function<void(const OrderEvent&)>;

} // namespace gnomon
