#include "server/redis/redis.h"

#include <iterator>
#include <utility>

#include "server/system/log.h"

namespace gnomon::redis {

/// One of the connections that may be open at once, for the time of a call.
class Redis::Place {
 public:
  /// Waits for one until the deadline.
  Place(Redis& redis, Clock::time_point deadline) : redis_(redis) {
    std::unique_lock lock(redis_.mutex_);
    taken_ = redis_.placeFree_.wait_until(lock, deadline, [&] { return redis_.taken_ < redis_.options_.connections; });
    if (!taken_) return;
    ++redis_.taken_;
    if (redis_.idle_.empty()) return;
    connection = std::move(redis_.idle_.back());
    redis_.idle_.pop_back();
  }

  ~Place() {
    if (!taken_) return;
    {
      const std::lock_guard lock(redis_.mutex_);
      --redis_.taken_;
      if (connection) redis_.idle_.push_back(std::move(connection));
    }
    redis_.placeFree_.notify_all();
  }

  bool isTaken() const { return taken_; }

  std::unique_ptr<Connection> connection; ///< kept for later calls

 private:
  Redis& redis_;
  bool taken_ = false;
};

Redis::Redis(Options options) : options_(std::move(options)), random_(std::random_device()()) {
  idle_.reserve(options_.connections);
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
    closing.assign(std::make_move_iterator(idle_.begin()), std::make_move_iterator(idle_.end()));
    idle_.clear();
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

Result<std::vector<Reply>> Redis::pipeline(const std::vector<Command>& commands, const Call& call) {
  const auto failed = [&](Problem problem) {
    const std::lock_guard lock(mutex_);
    ++counted_.failures;
    return problem;
  };
  {
    const std::lock_guard lock(mutex_);
    ++counted_.calls;
  }
  Place place(*this, call.deadline);
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

Result<Reply> Redis::ask(const Command& command, const Call& call) {
  auto replies = pipeline({command}, call);
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
  use.connections = taken_ + idle_.size();
  return use;
}

} // namespace gnomon::redis
