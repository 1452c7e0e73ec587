#include "server/frames/shared_frames.h"

#include <numeric>

namespace gnomon {

/// Another call's reply; nullptr where there is none for us.
std::shared_ptr<const HttpReply> SharedFrames::await(const std::shared_ptr<Flight>& flight, Clock::time_point deadline,
                                                     const Gone& gone, std::unique_lock<std::mutex>& lock) {
  constexpr std::chrono::milliseconds kPause{20};
  ++flight->joined;
  bool wanted = true;
  while (!flight->done && wanted && Clock::now() < deadline) {
    flight->changed.wait_for(lock, kPause);
    lock.unlock();
    wanted = !gone();
    lock.lock();
  }
  --flight->joined;
  return flight->done ? flight->reply : nullptr;
}

HttpReply SharedFrames::run(const std::string& etag, Clock::time_point deadline, const Gone& gone,
                            const std::function<HttpReply(const Gone&)>& draw) {
  std::unique_lock lock(mutex_);
  if (const auto found = flights_.find(etag); found != flights_.end()) {
    const auto flight = found->second; // it leaves the map when it is done
    const auto reply = await(flight, deadline, gone, lock);
    lock.unlock();
    if (!reply) return draw(gone);
    ++shared_;
    return *reply;
  }
  const auto flight = std::make_shared<Flight>();
  flights_[etag] = flight;
  lock.unlock();
  // What has ended is joined no more, however it ended. Waiting callers go on once the lock is released.
  const auto land = [&] {
    lock.lock();
    flights_.erase(etag);
    flight->done = true;
    flight->changed.notify_all();
  };
  HttpReply reply;
  try {
    reply = draw([&] {
      if (!gone()) return false;
      const std::lock_guard counting(mutex_);
      return flight->joined == 0;
    });
  } catch (...) {
    land();
    throw;
  }
  land();
  if (reply.status == 200 && flight->joined > 0) flight->reply = std::make_shared<HttpReply>(reply);
  return reply;
}

int SharedFrames::waiting() const {
  const std::lock_guard lock(mutex_);
  return std::transform_reduce(flights_.begin(), flights_.end(), 0, std::plus<>(),
                               [](const auto& flight) { return flight.second->joined; });
}

} // namespace gnomon
