#include <algorithm>
#include <array>
#include <utility>

#include "server/dispatch/dispatcher_parts.h"
#include "server/system/log.h"

/// What workers say. A parser in one may have been taken over, so that each message is checked as a request is, and one
/// that no honest worker sends costs the worker.
namespace gnomon {

/// False where the message is none, or none that this worker may send now.
bool Dispatcher::take(Slot& slot, Packet packet) {
  const auto message = readToFront(packet.text);
  if (!message || packet.files.size() > (message->outcome || message->made ? 1u : 0u)) return false;
  std::optional<SharedBytes> body;
  if (!packet.files.empty()) {
    body = sealedBytes(packet.files.front(), kMostResultBytes);
    if (!body) return false;
  }
  Lock lock(mutex_);
  slot.lastMessage = Clock::now();
  if (message->beat) takeBeat(slot, *message->beat);
  if (message->ready || message->refusal) return takeStart(slot, *message);
  if (message->event) return takeEvent(slot, *message->event, lock);
  if (message->outcome) return takeOutcome(slot, *message->outcome, std::move(body), lock);
  if (message->request || message->made) {
    const std::string& key = message->request ? message->request->key : message->made->key;
    if (!isAtWorkOn(slot, sceneOfLightMap(key)) || (message->made && !body)) return false;
    if (!options_.lightMaps) return true;
    slot.isHandled = true;
    lock.unlock();
    if (message->request) answerRequest(slot, *message->request);
    if (message->made) options_.lightMaps->write(key, packet.files.front());
    lock.lock();
    slot.lastMessage = Clock::now();
    slot.isHandled = false;
  }
  return true;
}

/// With the mutex held, as all below.
void Dispatcher::takeBeat(Slot& slot, const Beat& beat) {
  const auto since = [](std::uint64_t before, std::uint64_t now) { return now >= before ? now - before : now; };
  reusedMeshes_ += since(slot.beat.reusedMeshes, beat.reusedMeshes); // a new worker begins at 0
  reusedImages_ += since(slot.beat.reusedImages, beat.reusedImages);
  const std::vector<double> known = std::exchange(slot.beat, beat).costFactors;
  for (std::size_t i = 0; i < known.size() && i < beat.costFactors.size(); ++i) {
    if (beat.costFactors[i] != known[i]) costFactors_.parts[i] = beat.costFactors[i]; // what it has learned just now
  }
}

/// A worker says once that it is ready, or why it never will be.
bool Dispatcher::takeStart(Slot& slot, const ToFront& message) {
  if (slot.ready) return false;
  if (message.ready) {
    info_ = *message.ready;
    slot.ready = true;
    slot.failures = 0;
    logEvent("worker", "Worker " + std::to_string(slot.process->pid()) + " is ready: " + info_.backend + " " +
                           info_.platform + ", " + info_.renderer + ", " + info_.version + ".");
    placeWaiting();
  } else {
    refusal_ = message.refusal->problems;
  }
  changed_.notify_all();
  return true;
}

/// What an order's worker says is looked at without the mutex: nothing but this thread ends what runs.
bool Dispatcher::isFitting(Slot& slot, Lock& lock, const std::function<bool()>& look) {
  slot.isHandled = true;
  lock.unlock();
  const bool fits = look();
  lock.lock();
  slot.lastMessage = Clock::now();
  slot.isHandled = false;
  return fits;
}

bool Dispatcher::takeEvent(Slot& slot, const OrderEvent& event, Lock& lock) {
  constexpr std::size_t kMostUndelivered = 64 << 20; // bytes
  const auto found = slot.running.find(event.number);
  if (found == slot.running.end()) return false;
  const TicketPtr ticket = found->second;
  const Order order = ticket->task.order;
  Announced announced = ticket->announced;
  if (!isFitting(slot, lock, [&] { return maySend(order, event, announced); })) return false;
  ticket->announced = announced;
  if (ticket->calledOff) return true; // no caller takes it
  if (!ticket->isNews(event)) return true;
  ticket->eventBytes += event.data.size() + sizeof event;
  if (ticket->eventBytes > kMostUndelivered) return false;
  ticket->events.push_back(event);
  ticket->changed.notify_one();
  return true;
}

bool Dispatcher::takeOutcome(Slot& slot, const Outcome& outcome, std::optional<SharedBytes> body, Lock& lock) {
  const auto found = slot.running.find(outcome.number);
  if (found == slot.running.end()) return false;
  const TicketPtr ticket = found->second;
  const Order order = ticket->task.order;
  const Announced announced = ticket->announced;
  if (!isFitting(slot, lock, [&] { return mayEnd(order, outcome, body, announced); })) return false;
  slot.running.erase(outcome.number);
  finish(ticket, {outcome, std::move(body)});
  placeWaiting();
  return true;
}

/// A worker needs the light maps of a scene while it works on an order of it, and at no other time.
bool Dispatcher::isAtWorkOn(const Slot& slot, std::string_view scene) {
  return std::any_of(slot.running.begin(), slot.running.end(),
                     [&](const auto& each) { return each.second->task.order.scene == scene; });
}

void Dispatcher::answerRequest(Slot& slot, const LightMapRequest& request) {
  const FileDescriptor file = options_.lightMaps->open(request.key);
  const std::array files{file.get()};
  slot.process->channel().send(textOf(ToWorker{.lightMap = LightMapFound{request.number}}),
                               std::span(files).first(file ? 1 : 0));
}

} // namespace gnomon
