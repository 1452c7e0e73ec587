#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/http/connection.h"
#include "server/http/socket_io.h"

namespace gnomon {

/// A reply that is not sent whole, with all that is needed to go on.
struct HeldReply {
  HeldReply(HttpReply made, RequestRecord noted, std::shared_ptr<ClientWatch> watched, Holder from, bool mayKeep,
            bool isHead, bool knowsInterimReplies)
      : reply(std::move(made)),
        record(std::move(noted)),
        watch(std::move(watched)),
        holder(std::move(from)),
        keepAlive(mayKeep),
        bodyless(isHead),
        isHttp11(knowsInterimReplies) {}
  ~HeldReply() { watch->end(); } ///< before its socket is closed
  HeldReply(const HeldReply&) = delete;
  HeldReply& operator=(const HeldReply&) = delete;

  /// What became of a stream becomes the reply's.
  void takeResult();

  /// The request's end, in the log and for the observer.
  void end(const ConnectionContext& context);

  /// The same where not all of it was sent. Its socket is reset when it is closed.
  void lose(const ConnectionContext& context, Delivery how);

  HttpReply reply;
  RequestRecord record;
  std::shared_ptr<ClientWatch> watch;
  Holder holder; ///< by the client's address: whose threads and bytes it takes
  bool keepAlive;
  bool bodyless;
  bool isHttp11;
  bool isBegun = false; ///< the head of its stream is sent
};

/// Connections whose replies wait (ReplyWait): one thread looks after them all, sends what is news, and notices clients
/// that leave or take nothing. It sleeps until there is news, or a socket has some, or the next tenth of a second.
class WaitingReplies {
 public:
  using Leaving = std::function<void(OpenConnection)>;

  /// `goesOn`: takes those whose reply goes on with a thread, and those that have got all of it, which are ending.
  WaitingReplies(const ConnectionContext& context, Leaving goesOn);
  ~WaitingReplies();

  void adopt(OpenConnection connection) noexcept; ///< REQUIRES: its reply waits
  bool isEmpty();

 private:
  struct Waiter {
    OpenConnection connection;
    std::string unsent{};                   ///< of what it was to be sent
    bool isLast = false;                    ///< nothing comes after that
    bool mayAsk = false;                    ///< whether it is still there, by an interim reply
    bool isHalfClosed = false;              ///< it sends nothing more, but waits
    Clock::time_point moved = Clock::now(); ///< when something was sent last
    Delivery delivery = Delivery::whole;    ///< of what is lost
  };
  enum class Fate { stays, goesOn, isLost };

  void watch();
  static short eventsOf(const Waiter& waiter);
  Fate look(Waiter& waiter, short events);
  bool hasLeft(Waiter& waiter, short events);
  Delivery send(Waiter& waiter);
  void part(Waiter& waiter, Fate fate);

  const ConnectionContext& context_;
  const Leaving goesOn_;
  const std::shared_ptr<StopSignal> wake_ = std::make_shared<StopSignal>();
  std::mutex mutex_;
  std::list<Waiter> adopted_;
  std::size_t held_ = 0; ///< connections, adopted ones included
  bool stopping_ = false;
  std::list<Waiter> waiters_; ///< of the thread alone
  std::thread thread_;
};

} // namespace gnomon
