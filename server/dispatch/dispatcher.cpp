#include "server/dispatch/dispatcher.h"

#include <algorithm>
#include <exception>
#include <numeric>
#include <system_error>

#include "protocol/base/elapsed.h"
#include "server/dispatch/dispatcher_parts.h"
#include "server/system/file_descriptor.h"
#include "server/system/log.h"
#include "server/system/no_thread.h"

namespace gnomon {
namespace {

Problem endingProblem() {
  return {ProblemCode::unavailable, "", "The server is shutting down.", "", ""};
}

Problem lateProblem(bool waited) {
  return {
      ProblemCode::deadlineExceeded, "",
      waited ? "The request's deadline came before its turn." : "The work was not done before the request's deadline.",
      "", ""};
}

} // namespace

TaskResult failed(Problem problem, int retryAfterSeconds) {
  TaskResult result;
  result.outcome.problems = {std::move(problem)};
  result.outcome.retryAfterSeconds = retryAfterSeconds;
  return result;
}

TaskResult struck(StrikeList::Refusal refusal) {
  TaskResult result = failed(std::move(refusal.problem), refusal.retryAfterSeconds);
  if (refusal.isOfClient) result.refusal = TaskRefusal::client;
  return result;
}

FrameCost usualFactors() {
  FrameCost unit;
  unit.parts.fill(1);
  return CostModel().parts(unit);
}

Dispatcher::Dispatcher(DispatcherOptions options) : options_(std::move(options)), costFactors_(usualFactors()) {}

Result<std::unique_ptr<Dispatcher>> Dispatcher::start(DispatcherOptions options) {
  std::unique_ptr<Dispatcher> dispatcher(new Dispatcher(std::move(options)));
  for (std::size_t i = 0; i < dispatcher->options_.workers; ++i) {
    dispatcher->slots_.push_back(std::make_unique<Slot>());
  }
  const auto& startThread = dispatcher->options_.startThread;
  try {
    for (const auto& slot : dispatcher->slots_) {
      slot->thread = startThread([&dispatcher = *dispatcher, &slot = *slot] { dispatcher.keepWorking(slot); });
    }
    dispatcher->watching_ = startThread([&dispatcher = *dispatcher] { dispatcher.watch(); });
  } catch (const std::system_error&) {
    return noThreadFor("a worker");
  }
  Lock lock(dispatcher->mutex_);
  const auto anyReady = [&] {
    return std::any_of(dispatcher->slots_.begin(), dispatcher->slots_.end(),
                       [](const auto& slot) { return slot->ready; });
  };
  // All of them, so that scenes go to the workers where they stay.
  const auto allReady = [&] {
    return std::all_of(dispatcher->slots_.begin(), dispatcher->slots_.end(),
                       [](const auto& slot) { return slot->ready; });
  };
  dispatcher->changed_.wait(lock, [&] { return allReady() || dispatcher->refusal_; });
  if (!anyReady()) {
    Problems problems = *dispatcher->refusal_;
    lock.unlock();
    return problems;
  }
  return dispatcher;
}

Dispatcher::~Dispatcher() {
  {
    const Lock lock(mutex_);
    ending_ = true;
    for (const auto& slot : slots_) {
      if (slot->process) slot->process->kill();
    }
  }
  changed_.notify_all();
  for (const auto& slot : slots_) {
    if (slot->thread.joinable()) slot->thread.join();
  }
  if (watching_.joinable()) watching_.join();
}

TaskResult Dispatcher::run(Task task, const std::function<bool()>& gone, const TaskEvents& events) {
  constexpr std::chrono::milliseconds kPause{20};
  auto request = memoryFile(asBytes(task.request));
  if (!request || !task.bundle) {
    TaskResult result = failed({ProblemCode::unavailable, "", "There is no memory for the request.", "", ""});
    result.refusal = TaskRefusal::memory;
    return result;
  }
  const auto ticket = std::make_shared<Ticket>();
  ticket->request = std::make_shared<FileDescriptor>(*std::move(request));
  ticket->task = std::move(task);

  Lock lock(mutex_);
  if (auto refusal = strikes_.refusalOf(ticket->task, Clock::now())) return struck(*std::move(refusal));
  waiting_.push_back(ticket);
  try {
    placeWaiting();
  } catch (const std::exception& error) { // as where there is no memory
    logEvent("worker", error.what());
    if (ticket->state == Ticket::State::waiting) {
      refuse(ticket, failed({ProblemCode::internal, "", "The request could not be given to a worker.", "", ""}));
    }
  }
  if (waiting_.size() > options_.queueLimit) {
    refuseForQueue(newestOfBusiest());
  } else if (ticket->state == Ticket::State::waiting && !mayWait(*ticket)) {
    refuseForQueue(ticket);
  }
  while (true) {
    const auto deadline = std::min(ticket->task.deadline, endAt_);
    ticket->changed.wait_until(lock, std::min(deadline, Clock::now() + kPause),
                               [&] { return ticket->state == Ticket::State::done || !ticket->events.empty(); });
    const auto arrived = std::exchange(ticket->events, {});
    ticket->eventBytes = 0;
    const bool done = ticket->state == Ticket::State::done;
    lock.unlock();
    if (events) std::for_each(arrived.begin(), arrived.end(), events);
    if (done) return std::move(ticket->result);
    const bool left = gone();
    lock.lock();
    if (ticket->state == Ticket::State::done) continue;
    const bool waited = ticket->state == Ticket::State::waiting;
    if (left || Clock::now() >= deadline) {
      if (!waited && !left && deadline == ticket->task.deadline) learnFrom(*ticket, true);
      callOff(ticket);
      if (left) return failed({ProblemCode::unavailable, "", "The work was stopped before it was done.", "", ""});
      return failed(deadline < ticket->task.deadline ? endingProblem() : lateProblem(waited));
    }
  }
}

/// With the mutex held.
void Dispatcher::callOff(const TicketPtr& ticket) {
  if (ticket->state == Ticket::State::waiting) {
    waiting_.remove(ticket);
    ticket->state = Ticket::State::done;
    placeWaiting(); // it may have kept a worker free for itself
    return;
  }
  ticket->calledOff = Clock::now();
  Slot& slot = *slots_[ticket->slot];
  for (const auto& [number, running] : slot.running) {
    if (running == ticket && slot.process) slot.process->channel().send(textOf(ToWorker{.cancel = Cancel{number}}));
  }
}

/// With the mutex held.
void Dispatcher::finish(const TicketPtr& ticket, TaskResult result) {
  constexpr double kShare = 0.2; ///< of the newest task in the average
  const double took = millisecondsSince(ticket->since);
  taskMs_ = taskMs_ == 0 ? took : taskMs_ + kShare * (took - taskMs_);
  const Problems& problems = result.outcome.problems;
  const bool isLate = !problems.empty() && problems.front().code == ProblemCode::deadlineExceeded;
  if (!ticket->calledOff && (problems.empty() || isLate)) learnFrom(*ticket, isLate);
  ticket->result = std::move(result);
  ticket->state = Ticket::State::done;
  ticket->changed.notify_one();
}

/// What it took to draw a frame, or not to. With the mutex held.
void Dispatcher::learnFrom(const Ticket& ticket, bool isLate) {
  if (!ticket.task.cost) return;
  const double took = millisecondsSince(ticket.since);
  const double allowed = std::chrono::duration<double, std::milli>(ticket.task.allowed).count();
  constexpr double kAlmostAll = 0.9; // else the queue had a part in it
  if (!isLate) passedDeadlines_.done(*ticket.task.cost, took);
  if (isLate && took >= kAlmostAll * allowed) passedDeadlines_.passed(*ticket.task.cost, allowed, Clock::now());
}

double Dispatcher::leastMilliseconds(const FrameCost& cost) const {
  const Lock lock(mutex_);
  return passedDeadlines_.atLeast(cost, Clock::now());
}

double Dispatcher::milliseconds(const FrameSpec& spec, const SceneCounts& scene) const {
  const FrameCost cost = frameCost(spec, scene, kindOf(info()));
  const Lock lock(mutex_);
  return std::inner_product(cost.parts.begin(), cost.parts.end(), costFactors_.parts.begin(), 0.0);
}

void Dispatcher::forget(const std::string& scene) {
  const Lock lock(mutex_);
  for (const auto& slot : slots_) {
    if (slot->ready) slot->process->channel().send(textOf(ToWorker{.forget = Forget{scene}}));
  }
}

RendererInfo Dispatcher::info() const {
  const Lock lock(mutex_);
  return info_;
}

DispatcherState Dispatcher::state() const {
  const Lock lock(mutex_);
  DispatcherState state{.workers = options_.workers, .waiting = waiting_.size(), .limit = options_.queueLimit};
  for (const auto& slot : slots_) {
    state.ready += slot->ready ? 1 : 0;
    state.running += slot->running.size();
    for (const auto& [number, ticket] : slot->running)
      ++state.runningByLane[static_cast<std::size_t>(ticket->task.lane)];
  }
  for (const TicketPtr& ticket : waiting_) ++state.waitingByLane[static_cast<std::size_t>(ticket->task.lane)];
  if (state.ready == 0) state.noneReadyFor = Clock::now() - noneReadySince_;
  state.replacements = replacements_;
  state.reusedMeshes = reusedMeshes_;
  state.reusedImages = reusedImages_;
  return state;
}

std::uint64_t Dispatcher::residentBytes() const {
  std::vector<std::shared_ptr<WorkerProcess>> processes;
  {
    const Lock lock(mutex_);
    for (const auto& slot : slots_) processes.push_back(slot->process);
  }
  std::uint64_t bytes = 0;
  for (const auto& process : processes) bytes += process ? process->residentBytes() : 0;
  return bytes;
}

std::vector<pid_t> Dispatcher::processes() const {
  const Lock lock(mutex_);
  std::vector<pid_t> all;
  for (const auto& slot : slots_) all.push_back(slot->process ? slot->process->pid() : 0);
  return all;
}

void Dispatcher::endAt(Clock::time_point deadline) {
  const Lock lock(mutex_);
  endAt_ = deadline;
}

} // namespace gnomon
