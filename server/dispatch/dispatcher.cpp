#include "server/dispatch/dispatcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "protocol/base/elapsed.h"
#include "server/dispatch/dispatcher_parts.h"
#include "server/system/log.h"
#include "server/system/memory_file.h"

namespace gnomon {
namespace {

TaskResult failed(Problem problem, int retryAfterSeconds = 1) {
  TaskResult result;
  result.outcome.problems = {std::move(problem)};
  result.outcome.retryAfterSeconds = retryAfterSeconds;
  return result;
}

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

Dispatcher::Dispatcher(DispatcherOptions options) : options_(std::move(options)) {
  FrameCost unit;
  unit.parts.fill(1);
  costFactors_ = CostModel().parts(unit); // until a worker has learned
}

Result<std::unique_ptr<Dispatcher>> Dispatcher::start(DispatcherOptions options) {
  std::unique_ptr<Dispatcher> dispatcher(new Dispatcher(std::move(options)));
  for (std::size_t i = 0; i < dispatcher->options_.workers; ++i) {
    dispatcher->slots_.push_back(std::make_unique<Slot>());
  }
  for (const auto& slot : dispatcher->slots_) dispatcher->startSlot(*slot);
  if (dispatcher->options_.each.device == DeviceChoice::auto_) {
    dispatcher->slots_.push_back(std::make_unique<Slot>());
    dispatcher->slots_.back()->loadsDrivers = true;
  }
  dispatcher->watching_ = std::thread([&dispatcher = *dispatcher] { dispatcher.watch(); });
  Lock lock(dispatcher->mutex_);
  const auto anyReady = [&] {
    return std::any_of(dispatcher->slots_.begin(), dispatcher->slots_.end(),
                       [](const auto& slot) { return slot->ready; });
  };
  // All of them, so that scenes go to the workers where they stay.
  const auto allReady = [&] {
    return std::all_of(dispatcher->slots_.begin(), dispatcher->slots_.end(),
                       [](const auto& slot) { return slot->ready || slot->loadsDrivers; });
  };
  dispatcher->changed_.wait(lock, [&] { return allReady() || dispatcher->refusal_; });
  if (!anyReady()) {
    Problems problems = *dispatcher->refusal_;
    lock.unlock();
    return problems;
  }
  return dispatcher;
}

void Dispatcher::startSlot(Slot& slot) {
  slot.thread = std::thread([this, &slot] { keepWorking(slot); });
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
  waiting_.push_back(ticket);
  placeWaiting();
  if (ticket->state == Ticket::State::waiting && waiting_.size() > options_.queueLimit) {
    waiting_.remove(ticket);
    TaskResult result = failed({ProblemCode::busy, "", "The queue before the workers is full.",
                                std::to_string(options_.queueLimit) + " requests", ""},
                               retryAfterSeconds());
    result.refusal = TaskRefusal::queue;
    return result;
  }
  while (true) {
    const auto deadline = std::min(ticket->task.deadline, endAt_);
    ticket->changed.wait_until(lock, std::min(deadline, Clock::now() + kPause));
    const auto told = std::exchange(ticket->events, {});
    const bool done = ticket->state == Ticket::State::done;
    lock.unlock();
    if (events) std::for_each(told.begin(), told.end(), events);
    if (done) return std::move(ticket->result);
    const bool left = gone();
    lock.lock();
    if (ticket->state == Ticket::State::done) continue;
    const bool waited = ticket->state == Ticket::State::waiting;
    if (left || Clock::now() >= deadline) {
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
bool Dispatcher::suits(const Slot& slot, bool needsDriver) const {
  const bool apart = info_.device == DeviceChoice::cpu && options_.each.device == DeviceChoice::auto_;
  return slot.loadsDrivers == (needsDriver && apart);
}

/// Gives workers what they can take. Those who have to be alone come first, then whoever has the fewest tasks in
/// progress, then who came first. With the mutex held.
void Dispatcher::placeWaiting() {
  std::map<std::string, int> inProgress;
  for (const auto& slot : slots_) {
    for (const auto& [number, ticket] : slot->running) ++inProgress[ticket->task.client];
  }
  // Those for tasks that need no driver, and those for tasks that do.
  struct Group {
    std::vector<std::size_t> slots;
    std::vector<WorkerView> workers;
  };
  std::array<Group, 2> groups;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    for (const bool needsDriver : {false, true}) {
      if (!suits(*slots_[i], needsDriver)) continue;
      groups[needsDriver].slots.push_back(i);
      groups[needsDriver].workers.push_back(slots_[i]->view());
    }
  }
  std::vector<TicketPtr> order(waiting_.begin(), waiting_.end());
  while (!order.empty()) {
    const auto next = std::min_element(order.begin(), order.end(), [&](const TicketPtr& a, const TicketPtr& b) {
      if (a->mustBeAlone() != b->mustBeAlone()) return a->mustBeAlone();
      return inProgress[a->task.client] < inProgress[b->task.client];
    });
    const TicketPtr ticket = *next;
    order.erase(next);
    auto& [slots, workers] = groups[ticket->task.needsDriver];
    if (slots.size() == 1 && !slots_[slots[0]]->thread.joinable()) startSlot(*slots_[slots[0]]);
    std::optional<std::size_t> place;
    if (ticket->mustBeAlone()) {
      const auto lone = lonePlaceFor(ticket->task, workers);
      if (lone) workers[lone->worker].reserved = true;
      if (lone && lone->free) place = lone->worker;
    } else {
      place = placeFor(ticket->task, workers);
    }
    if (!place) continue;
    waiting_.remove(ticket);
    ++inProgress[ticket->task.client];
    ++workers[*place].running[static_cast<std::size_t>(ticket->task.lane)];
    workers[*place].holdingRenderer += ticket->task.holdsRenderer ? 1 : 0;
    send(ticket, slots[*place]);
  }
}

/// With the mutex held.
void Dispatcher::send(const TicketPtr& ticket, std::size_t worker) {
  Slot& slot = *slots_[worker];
  const double waited = millisecondsSince(ticket->since);
  if (options_.waited) options_.waited(ticket->task.lane, waited / 1000);
  ticket->waitedMilliseconds += waited;
  ticket->since = Clock::now();
  ticket->state = Ticket::State::running;
  ticket->slot = worker;
  Order& order = ticket->task.order;
  order.number = ++numbers_;
  order.queuedMilliseconds = ticket->waitedMilliseconds;
  order.milliseconds = std::chrono::duration<double, std::milli>(ticket->task.deadline - Clock::now()).count();
  slot.running.emplace(order.number, ticket);
  const std::array files{ticket->task.bundle->get(), ticket->request->get()};
  if (!slot.process->channel().send(textOf(ToWorker{.order = order}), files)) {
    // The task comes back as the worker goes.
    endWorker(slot, {{ProblemCode::internal, "", "It did not read its messages.", "", ""}, WorkerEnd::silence});
  }
}

/// With the mutex held.
void Dispatcher::finish(const TicketPtr& ticket, TaskResult result) {
  constexpr double kShare = 0.2; ///< of the newest task in the average
  const double took = millisecondsSince(ticket->since);
  taskMs_ = taskMs_ == 0 ? took : taskMs_ + kShare * (took - taskMs_);
  ticket->result = std::move(result);
  ticket->state = Ticket::State::done;
  ticket->changed.notify_one();
}

/// Until there is a place in the queue, from what tasks took lately and how long those in progress have run already:
/// 1..60. With the mutex held.
int Dispatcher::retryAfterSeconds() const {
  double each = taskMs_;
  std::size_t places = 0;
  for (const auto& slot : slots_) {
    places += slot->ready ? 1 : 0;
    for (const auto& [number, ticket] : slot->running) each = std::max(each, millisecondsSince(ticket->since));
  }
  const double seconds = std::ceil(each * static_cast<double>(waiting_.size() + 1) /
                                   (1000.0 * static_cast<double>(std::max<std::size_t>(places, 1))));
  return static_cast<int>(std::clamp(seconds, 1.0, 60.0));
}

double Dispatcher::milliseconds(const FrameCost& cost) const {
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
  state.replacements = replacements_;
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
