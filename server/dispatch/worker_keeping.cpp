#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "server/dispatch/dispatcher_parts.h"
#include "server/system/log.h"

/// How a dispatcher starts its workers, listens to them, watches and replaces them.
namespace gnomon {
namespace {

constexpr std::chrono::seconds kStartPatience{60}; ///< drivers compile
constexpr std::chrono::milliseconds kWatchPause{50};

Problem endedOver(int times, const Problem& fault) {
  Problem problem = fault;
  const std::string workers = times == 1 ? "A worker" : times == 2 ? "Two workers" : std::to_string(times) + " workers";
  problem.detail = workers + " ended over this request. " + fault.detail;
  return problem;
}

Problem faultProblem(std::string detail) {
  return {ProblemCode::internal, "", std::move(detail), "", ""};
}

} // namespace

/// A slot's thread: one worker after the other.
void Dispatcher::keepWorking(Slot& slot) {
  while (true) {
    guarded(slot, [&] {
      if (startWorker(slot)) listen(slot);
    });
    guarded(slot, [&] { replaceWorker(slot); });
    Lock lock(mutex_);
    constexpr int kMostDoublings = 7;
    const auto pause =
        std::chrono::milliseconds(slot.failures == 0 ? 0 : 50 << std::min(slot.failures, kMostDoublings));
    if (changed_.wait_for(lock, pause, [&] { return ending_; })) return;
  }
}

/// What `work` throws, as where there is no memory, costs the slot's worker. If it left the thread, it would end the
/// process.
void Dispatcher::guarded(Slot& slot, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    logEvent("worker", error.what());
    const Lock lock(mutex_);
    ++slot.failures; // so that the next one does not follow at once
    try {
      const Problem problem = faultProblem("The server could not handle its messages.");
      if (!slot.ready && !refusal_) refusal_ = Problems{problem};
      if (slot.fault.problem.detail.empty()) slot.fault = {problem, WorkerEnd::crash};
    } catch (const std::bad_alloc&) { // it ends without a reason
    }
    changed_.notify_all();
  }
}

bool Dispatcher::startWorker(Slot& slot) {
  auto started = WorkerProcess::start(options_.program);
  const Lock lock(mutex_);
  if (!started) {
    refusal_ = started.problems();
    changed_.notify_all();
    return false;
  }
  slot.process = *std::move(started);
  slot.lastMessage = Clock::now();
  slot.fault = {};
  slot.isHandled = false;
  const FrameCost unlearned = usualFactors();
  slot.beat.costFactors.assign(unlearned.parts.begin(), unlearned.parts.end());
  if (ending_) slot.process->kill();
  return slot.process->channel().send(textOf(ToWorker{.start = options_.each}));
}

/// Until the worker's end of the channel is closed.
void Dispatcher::listen(Slot& slot) {
  while (true) {
    Packet packet;
    const ChannelEvent event = slot.process->channel().receive(packet, std::chrono::seconds(1));
    if (event == ChannelEvent::timeout) continue;
    if (event == ChannelEvent::packet && take(slot, std::move(packet))) continue;
    const Lock lock(mutex_);
    if (event != ChannelEvent::ended) endWorker(slot, {faultProblem("It sent what is no message."), WorkerEnd::crash});
    return;
  }
}

/// Clears up after a worker: its tasks wait again, or are done.
void Dispatcher::replaceWorker(Slot& slot) {
  if (!slot.process) {
    ++slot.failures;
    return;
  }
  slot.process->kill(); // without its channel it is of no use
  const WorkerProcess::Ending ending = slot.process->end();
  const Lock lock(mutex_);
  const bool isForeign = ending.isKilled && slot.fault.problem.detail.empty(); // we did not kill it
  if (!ending_) {
    ++replacements_[static_cast<std::size_t>(slot.fault.end)];
    logEvent("worker", "Worker " + std::to_string(slot.process->pid()) + " ended with " + ending.how + ". " +
                           slot.fault.problem.detail);
  }
  if (!slot.ready) ++slot.failures;
  if (!slot.ready && !refusal_) {
    refusal_ = Problems{{ProblemCode::backend, "", "A worker ended before it could draw.", "", ending.how}};
    changed_.notify_all();
  }
  if (std::exchange(slot.ready, false)) noneReadySince_ = Clock::now();
  slot.process.reset();
  if (!isForeign) countEnds(slot);
  for (const auto& [number, ticket] : std::exchange(slot.running, {})) {
    if (ticket->calledOff) continue;
    ++ticket->ends;
    ticket->kills += isForeign ? 1 : 0;
    if (ticket->mayBeTriedAgain()) {
      ticket->beginAgain();
      ticket->state = Ticket::State::waiting;
      ticket->since = Clock::now();
      waiting_.push_front(ticket);
    } else {
      TaskResult result;
      result.outcome.problems = {endedOver(ticket->ends, slot.fault.problem)};
      for (int i = 0; i < ticket->kills; ++i) strikes_.addEnd(ticket->task.client.name, Clock::now());
      strikes_.addRequest(ticket->task, result.outcome.problems.front(), Clock::now());
      if (slot.fault.end == WorkerEnd::memory) result.refusal = TaskRefusal::memory;
      finish(ticket, std::move(result));
    }
  }
  refuseStruck();
  placeWaiting();
}

/// Whose tasks ended the slot's worker. Of several it is only known of those that will not be tried again alone.
void Dispatcher::countEnds(const Slot& slot) {
  for (const auto& [number, ticket] : slot.running) {
    if (slot.running.size() == 1 || ticket->calledOff) strikes_.addEnd(ticket->task.client.name, Clock::now());
  }
}

/// Ends what waits of clients whose tasks ended too many workers.
void Dispatcher::refuseStruck() {
  for (const TicketPtr& ticket : std::vector(waiting_.begin(), waiting_.end())) {
    if (auto refusal = strikes_.refusalOf(ticket->task.client.name, Clock::now()))
      refuse(ticket, struck(*std::move(refusal)));
  }
}

/// The watching thread.
void Dispatcher::watch() {
  Lock lock(mutex_);
  while (!changed_.wait_for(lock, kWatchPause, [&] { return ending_; })) {
    try {
      for (const auto& slot : slots_) {
        if (!slot->process || !slot->fault.problem.detail.empty()) continue;
        if (auto fault = faultOf(*slot)) endWorker(*slot, *std::move(fault));
      }
    } catch (const std::exception& error) { // as where there is no memory; it looks again soon
      logEvent("worker", error.what());
    }
  }
}

/// Why a worker must be replaced. With the mutex held.
std::optional<Dispatcher::Fault> Dispatcher::faultOf(const Slot& slot) const {
  const auto now = Clock::now();
  if (!slot.ready && now - slot.lastMessage > kStartPatience) {
    return Fault{faultProblem("It did not become ready."), WorkerEnd::silence};
  }
  if (slot.ready && !slot.isHandled && now - slot.lastMessage > options_.responseTimeout) {
    return Fault{faultProblem("It stopped responding."), WorkerEnd::silence};
  }
  for (const auto& [number, ticket] : slot.running) {
    if (ticket->calledOff && now - *ticket->calledOff > options_.stopping) {
      return Fault{faultProblem("It did not stop work that was cancelled."), WorkerEnd::notStopping};
    }
  }
  if (options_.each.memoryBytes > 0 && slot.process->residentBytes() > options_.each.memoryBytes) {
    return Fault{{ProblemCode::tooLarge, "", "It used more memory than it may.",
                  std::to_string(options_.each.memoryBytes) + " bytes", ""},
                 WorkerEnd::memory};
  }
  return std::nullopt;
}

/// With the mutex held.
void Dispatcher::endWorker(Slot& slot, Fault fault) {
  slot.fault = std::move(fault);
  slot.process->kill();
}

} // namespace gnomon
