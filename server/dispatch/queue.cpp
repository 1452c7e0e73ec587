// The queue: which task is next, where each task goes, and which is refused once too many wait. All with the mutex
// held.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <tuple>
#include <utility>

#include "protocol/base/elapsed.h"
#include "server/dispatch/dispatcher_parts.h"
#include "server/system/fair_shares.h"
#include "server/system/log.h"

namespace gnomon {

/// Ends a task that no worker has. How long it was there says nothing about how long tasks take.
void Dispatcher::refuse(const TicketPtr& ticket, TaskResult result) {
  waiting_.remove(ticket);
  ticket->result = std::move(result);
  ticket->state = Ticket::State::done;
  ticket->changed.notify_one();
}

/// Gives workers what they can take. Tasks that must be alone come first, then those of the site with the fewest tasks
/// in progress, in it those of the client with the fewest, then the oldest.
void Dispatcher::placeWaiting() {
  std::map<std::string, int> ofSite;
  std::map<std::string, int> ofClient;
  const auto begun = [&](const ClientIdentity& client) {
    ++ofSite[client.site];
    ++ofClient[client.name];
  };
  const auto inProgress = [&](const ClientIdentity& client) {
    return std::pair(ofSite[client.site], ofClient[client.name]);
  };
  std::vector<WorkerView> workers;
  for (const auto& slot : slots_) {
    workers.push_back(slot->view());
    for (const auto& [number, ticket] : slot->running) begun(ticket->task.client);
  }
  std::vector<TicketPtr> order(waiting_.begin(), waiting_.end());
  while (!order.empty()) {
    const auto next = std::min_element(order.begin(), order.end(), [&](const TicketPtr& a, const TicketPtr& b) {
      if (a->mustBeAlone() != b->mustBeAlone()) return a->mustBeAlone();
      return inProgress(a->task.client) < inProgress(b->task.client);
    });
    const TicketPtr ticket = *next;
    order.erase(next);
    std::optional<std::size_t> place;
    if (ticket->mustBeAlone()) {
      const auto lone = lonePlaceFor(ticket->task, workers);
      if (lone) workers[lone->worker].reserved = true;
      if (lone && lone->free) place = lone->worker;
    } else {
      place = placeFor(ticket->task, workers);
    }
    if (!place) continue;
    try {
      if (!send(ticket, *place)) {
        workers[*place].ready = false;
        continue;
      }
    } catch (const std::exception& error) { // as where there is no memory; this task alone has no turn then
      logEvent("worker", error.what());
      slots_[*place]->running.erase(ticket->task.order.number);
      refuse(ticket, failed({ProblemCode::internal, "", "The request could not be sent to a worker.", "", ""}));
      continue;
    }
    begun(ticket->task.client);
    ++workers[*place].running[static_cast<std::size_t>(ticket->task.lane)];
    workers[*place].holdingRenderer += ticket->task.holdsRenderer ? 1 : 0;
  }
}

/// False where the worker can't be sent it: it is replaced then, and the task, which it never had, waits on.
bool Dispatcher::send(const TicketPtr& ticket, std::size_t worker) {
  Slot& slot = *slots_[worker];
  Channel& channel = slot.process->channel();
  const double waited = millisecondsSince(ticket->since);
  if (options_.waited) options_.waited(ticket->task.lane, waited / 1000);
  ticket->waitedMilliseconds += waited;
  ticket->since = Clock::now();
  Order& order = ticket->task.order;
  order.number = ++numbers_;
  order.queuedMilliseconds = ticket->waitedMilliseconds;
  order.milliseconds = std::chrono::duration<double, std::milli>(ticket->task.deadline - Clock::now()).count();
  ticket->announced = {};
  slot.running.emplace(order.number, ticket);
  const std::array files{ticket->task.bundle->get(), ticket->request->get()};
  if (!channel.send(textOf(ToWorker{.order = order}), files)) {
    slot.running.erase(order.number);
    if (!channel.hasEnded()) {
      endWorker(slot, {{ProblemCode::internal, "", "It did not read its messages.", "", ""}, WorkerEnd::silence});
    }
    return false;
  }
  waiting_.remove(ticket);
  ticket->state = Ticket::State::running;
  ticket->slot = worker;
  return true;
}

/// Whether the client of a task that came last has less than its share of the places without it.
bool Dispatcher::mayWait(const Ticket& last) const {
  SharedUse others{.capacity = options_.queueLimit, .taken = waiting_.size() - 1};
  for (const TicketPtr& ticket : waiting_) {
    if (ticket.get() == &last) continue;
    others.byClient += ticket->task.client.name == last.task.client.name ? 1 : 0;
    others.bySite += ticket->task.client.site == last.task.client.site ? 1 : 0;
  }
  return mayTake(others, 1, Share::half);
}

/// Of a full queue, the newest task of the client that has the most there, so that a client that comes gets a place as
/// long as another has several.
Dispatcher::TicketPtr Dispatcher::newestOfBusiest() const {
  std::map<std::string, std::size_t> ofSite;
  std::map<std::string, std::size_t> ofClient;
  for (const TicketPtr& ticket : waiting_) {
    ++ofSite[ticket->task.client.site];
    ++ofClient[ticket->task.client.name];
  }
  const auto key = [&](const TicketPtr& ticket) {
    const ClientIdentity& client = ticket->task.client;
    const bool mayGo = !ticket->mustBeAlone(); // else it was taken long ago
    return std::tuple(mayGo, ofSite[client.site], ofClient[client.name], ticket->since);
  };
  return *std::max_element(waiting_.begin(), waiting_.end(),
                           [&](const TicketPtr& a, const TicketPtr& b) { return key(a) < key(b); });
}

void Dispatcher::refuseForQueue(const TicketPtr& ticket) {
  const bool isFull = waiting_.size() > options_.queueLimit;
  TaskResult result = failed(
      {ProblemCode::busy, "",
       isFull ? "The queue before the workers is full." : "This client has its share of the queue before the workers.",
       std::to_string(options_.queueLimit) + " requests", ""},
      retryAfterSeconds());
  result.refusal = TaskRefusal::queue;
  refuse(ticket, std::move(result));
}

/// Until there is a place in the queue, from what tasks took lately and how long those in progress have run already:
/// 1..60.
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

} // namespace gnomon
