#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <string>

#include "server/dispatch/dispatcher.h"
#include "server/wire/answers.h"

/// What Dispatcher's source files share. Everything here is guarded by the dispatcher's mutex.
namespace gnomon {

/// The result of a task that no worker has done.
TaskResult failed(Problem problem, int retryAfterSeconds = 1);

/// The result of a task that no worker is given.
TaskResult struck(StrikeList::Refusal refusal);
/// Milliseconds for a unit of each part of a frame's cost, where no worker has learned them.
FrameCost usualFactors();

/// A task, from its arrival to its result.
struct Dispatcher::Ticket {
  enum class State { waiting, running, done };

  Task task;
  std::shared_ptr<FileDescriptor> request; ///< its JSON
  State state = State::waiting;
  Clock::time_point since = Clock::now(); ///< that it waits, or runs
  double waitedMilliseconds = 0;
  int ends = 0;                               ///< of workers that had it
  int kills = 0;                              ///< of them, those that another process killed
  std::size_t slot = 0;                       ///< where it runs
  std::optional<Clock::time_point> calledOff; ///< no caller waits for it any more
  std::deque<OrderEvent> events;              ///< not delivered yet
  std::size_t eventBytes = 0;                 ///< of them
  Announced announced;                        ///< by its events
  struct Heard {
    std::size_t before = 0; ///< events that the caller was sent, from earlier workers
    std::size_t now = 0;    ///< that came from the worker that has the task
  };
  std::map<std::string, Heard> heard; ///< by the event's name
  TaskResult result;
  std::condition_variable changed;

  /// Its worker ended: it is tried again, with no other task beside it.
  bool mustBeAlone() const { return ends > 0; }

  /// Not once two workers ended over it. It is hardly why a worker is killed from outside; but the system kills what
  /// takes too much memory, so that there is an end to that, too.
  bool mayBeTriedAgain() const { return ends - kills < 2 && ends < 5; }

  /// False for what an earlier worker has sent already. Of frames of sequences all is sent again.
  bool isNews(const OrderEvent& event) {
    if (task.order.kind == OrderKind::sequenceFrame) return true;
    Heard& of = heard[event.name];
    return ++of.now > of.before;
  }

  /// Its worker ended: the next one begins at the start.
  void beginAgain() {
    for (auto& [name, of] : heard) of = {std::max(of.before, of.now), 0};
  }
};

/// One of the places for workers, and the one that is there.
struct Dispatcher::Slot {
  std::shared_ptr<WorkerProcess> process; ///< null between two
  bool ready = false;
  Clock::time_point lastMessage; ///< when its last message came, or its start
  bool isHandled = false;        ///< a message of it is being handled, so that no other is read
  Fault fault{};                 ///< why it was killed; no detail = it wasn't
  int failures = 0;              ///< in a row, before it was ready
  std::map<std::uint64_t, TicketPtr> running;
  Beat beat;
  std::thread thread;

  WorkerView view() const {
    WorkerView view{.ready = ready && fault.problem.detail.empty()};
    for (const auto& [number, ticket] : running) {
      ++view.running[static_cast<std::size_t>(ticket->task.lane)];
      view.holdingRenderer += ticket->task.holdsRenderer ? 1 : 0;
      view.reserved = view.reserved || ticket->mustBeAlone();
    }
    return view;
  }
};

} // namespace gnomon
