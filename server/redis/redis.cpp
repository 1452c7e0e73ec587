#include "server/redis/redis.h"

#include <algorithm>
#include <utility>

#include "server/redis/backoff.h"
#include "server/system/log.h"

namespace gnomon::redis {

/// One of a pool's connections that may be open at once, for the time of a call.
class Redis::Place {
 public:
  /// Waits for one until the deadline.
  Place(Redis& redis, Pool& pool, Clock::time_point deadline) : redis_(redis), pool_(pool) {
    std::unique_lock lock(redis_.mutex_);
    taken_ = redis_.placeFree_.wait_until(lock, deadline, [&] { return pool_.taken < pool_.most; });
    if (!taken_) return;
    ++pool_.taken;
    if (pool_.idle.empty()) return;
    connection = std::move(pool_.idle.back());
    pool_.idle.pop_back();
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  ~Place() {
    if (!taken_) return;
    {
      const std::lock_guard lock(redis_.mutex_);
      --pool_.taken;
      if (connection) pool_.idle.push_back(std::move(connection));
    }
    redis_.placeFree_.notify_all();
  }

  bool isTaken() const { return taken_; }

  std::unique_ptr<Connection> connection; ///< kept for later calls

 private:
  Redis& redis_;
  Pool& pool_;
  bool taken_ = false;
};

Redis::Redis(Options options)
    : options_(std::move(options)),
      pool_{options_.connections},
      blocking_{options_.blockingConnections},
      random_(std::random_device()()) {
  pool_.idle.reserve(pool_.most);
  blocking_.idle.reserve(blocking_.most);
}

Problem Redis::away() const {
  return {ProblemCode::unavailable, "", "The server's Redis is away. Ask again in a few seconds.", "", ""};
}

/// Says so in the log, once. What is idle is closed: it has most likely ended, too. Calls that fail together are one
/// failure; `isProbe`: this one was made because others had failed, and is a further one.
Problem Redis::lost(const Problem& reason, bool isProbe) {
  std::vector<std::unique_ptr<Connection>> closing;
  bool isNews = false;
  {
    const std::lock_guard lock(mutex_);
    isNews = failuresInARow_ == 0;
    if (isNews || isProbe) {
      const double random = static_cast<double>(random_()) / static_cast<double>(std::minstd_rand::max());
      nextAttempt_ = Clock::now() + backoffDelay(++failuresInARow_, random);
    }
    for (Pool* pool : {&pool_, &blocking_}) {
      std::move(pool->idle.begin(), pool->idle.end(), std::back_inserter(closing));
      pool->idle.clear();
    }
  }
  if (isNews) logEvent("redis", shownText(options_.address) + " is away. " + reason.detail + ".");
  return away();
}

void Redis::reached() {
  bool isNews = false;
  {
    const std::lock_guard lock(mutex_);
    isNews = std::exchange(failuresInARow_, 0) > 0;
    ++counted_.connected;
  }
  if (isNews) logEvent("redis", shownText(options_.address) + " is back.");
}

Result<std::unique_ptr<Connection>> Redis::connect(const Call& call) {
  const auto now = Clock::now();
  bool isProbe = false;
  {
    const std::lock_guard lock(mutex_);
    isProbe = failuresInARow_ > 0;
    if (isProbe && now < nextAttempt_) return away();
    if (isProbe) nextAttempt_ = now + options_.connectPatience; // others do not try meanwhile
  }
  auto opened = Connection::open(options_.address,
                                 {std::min(call.deadline, now + options_.connectPatience), ReplyLimits{}, call.cut});
  if (!opened) return call.cut != nullptr && call.cut->raised() ? away() : lost(opened.problems().front(), isProbe);
  reached();
  return opened;
}

Result<std::vector<Reply>> Redis::call(Pool& pool, const std::vector<Command>& commands, const Call& call) {
  const auto failed = [&](Problem problem) {
    const std::lock_guard lock(mutex_);
    ++counted_.failures;
    return problem;
  };
  {
    const std::lock_guard lock(mutex_);
    ++counted_.calls;
  }
  Place place(*this, pool, call.deadline);
  if (!place.isTaken()) return failed(away());
  if (place.connection && !place.connection->isQuiet()) place.connection.reset();
  if (!place.connection) {
    auto opened = connect(call);
    if (!opened) return failed(opened.problems().front());
    place.connection = *std::move(opened);
  }
  auto replies = place.connection->exchange(commands, call);
  if (replies) {
    const auto isOfReplica = [](const Reply& reply) { return reply.isError("READONLY"); };
    if (std::any_of(replies->begin(), replies->end(), isOfReplica)) {
      place.connection.reset(); // another server has become the one to write to
    }
    return replies;
  }
  place.connection.reset();
  const bool isCut = call.cut != nullptr && call.cut->raised();
  return failed(isCut ? away() : lost(replies.problems().front(), false));
}

Result<std::vector<Reply>> Redis::pipeline(const std::vector<Command>& commands, const Call& call) {
  return this->call(pool_, commands, call);
}

Result<Reply> Redis::ask(const Command& command, const Call& call) {
  auto replies = pipeline({command}, call);
  if (!replies) return std::move(replies).problems();
  return std::move(replies->front());
}

Result<Reply> Redis::block(const Command& command, const Call& call) {
  auto replies = this->call(blocking_, {command}, call);
  if (!replies) return std::move(replies).problems();
  return std::move(replies->front());
}

Result<Reply> Redis::run(const Script& script, const std::vector<std::string>& keys,
                         const std::vector<std::string>& arguments, const Call& call) {
  Command command{"EVALSHA", script.sha1(), std::to_string(keys.size())};
  command.insert(command.end(), keys.begin(), keys.end());
  command.insert(command.end(), arguments.begin(), arguments.end());
  auto reply = ask(command, call);
  if (!reply || !reply->isError("NOSCRIPT")) return reply;
  command[0] = "EVAL"; // which the server remembers
  command[1] = script.text();
  return ask(command, call);
}

Clock::time_point Redis::nextAttempt() const {
  const std::lock_guard lock(mutex_);
  return failuresInARow_ > 0 ? nextAttempt_ : Clock::time_point::min();
}

Use Redis::use() const {
  const std::lock_guard lock(mutex_);
  Use use = counted_;
  use.isReachable = failuresInARow_ == 0;
  use.connections = pool_.taken + pool_.idle.size() + blocking_.taken + blocking_.idle.size();
  return use;
}

} // namespace gnomon::redis
