#include "server/dispatch/strike_list.h"

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

/// Equal for tasks that have a worker do the same.
std::string strikeKey(const Task& task) {
  Sha256 hash;
  hash.add(std::to_string(static_cast<int>(task.order.kind)) + "\n" + task.order.scene + "\n" + task.request);
  return hash.hex();
}

/// 1 at least.
int wholeSeconds(Clock::duration left) {
  return static_cast<int>(std::chrono::ceil<std::chrono::seconds>(left).count());
}

} // namespace

void StrikeList::addRequest(const Task& task, Problem problem, Clock::time_point now) {
  const std::string key = strikeKey(task);
  requests_.eraseIf([&](const Request& request) { return request.key == key || request.until <= now; });
  requests_.add({key, std::move(problem), now + kRequestRest});
  requests_.keepNewest(kMost);
}

void StrikeList::addEnd(const std::string& client, Clock::time_point now) {
  clients_.eraseIf([&](const Client& known) { return now - known.ends.back() >= kClientWindow; });
  Client* known = clients_.find(client, &Client::name);
  if (known == nullptr) known = &clients_.add({client, {}});
  known->ends.push_back(now);
  if (known->ends.size() > kClientEnds) known->ends.pop_front();
  clients_.keepNewest(kMost);
}

std::optional<StrikeList::Refusal> StrikeList::refusalOf(const Task& task, Clock::time_point now) {
  if (auto refusal = refusalOf(task.client.name, now)) return refusal;
  if (requests_.size() == 0) return std::nullopt;
  const Request* const request = requests_.find(strikeKey(task), &Request::key);
  if (request == nullptr || request->until <= now) return std::nullopt;
  Refusal refusal{request->problem, wholeSeconds(request->until - now)};
  refusal.problem.detail +=
      " It is not tried again before " + std::to_string(refusal.retryAfterSeconds) + " seconds have passed.";
  return refusal;
}

std::optional<StrikeList::Refusal> StrikeList::refusalOf(const std::string& client, Clock::time_point now) {
  const Client* const known = clients_.find(client, &Client::name);
  if (known == nullptr || known->ends.size() < kClientEnds) return std::nullopt;
  const auto left = known->ends.front() + kClientWindow - now;
  if (left <= Clock::duration::zero()) return std::nullopt;
  return Refusal{{ProblemCode::busy, "", "Requests of this client ended too many workers within a minute.",
                  "fewer than " + std::to_string(kClientEnds), ""},
                 wholeSeconds(left),
                 true};
}

} // namespace gnomon
