#include "server/http/waiting_replies.h"

#include <atomic>
#include <gtest/gtest.h>
#include <memory>
#include <mutex>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include "tests/server/http/connection_fixture.h"

namespace gnomon {
namespace {

/// What a test has a reply wait for.
class TestedWait final : public ReplyWait {
 public:
  void put(News news) {
    const std::lock_guard lock(mutex_);
    news_ = std::move(news);
    if (wake_) wake_->raise();
  }
  void wakeBy(const std::shared_ptr<StopSignal>& news) override {
    const std::lock_guard lock(mutex_);
    wake_ = news;
  }
  News look() override {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, {});
  }

 private:
  std::mutex mutex_;
  News news_;
  std::shared_ptr<StopSignal> wake_;
};

/// "/later" waits and then is "the reply"; "/events" begins at once, goes on where its wait does, and has "more" from a
/// thread. "/none" does not wait.
class WaitingRepliesTest : public ConnectionTest {
 protected:
  WaitingRepliesTest() {
    context_.service = [this](const HttpRequest& head) -> std::variant<RequestHandler, HttpReply> {
      RequestHandler handler;
      handler.answer = [this, name = head.path.at(0)](const HttpRequest& request, const std::function<bool()>&) {
        return answer(name, request);
      };
      return handler;
    };
  }

  HttpReply answer(const std::string& name, const HttpRequest& request) {
    if (name == "none") return echo(request);
    auto wait = std::make_shared<TestedWait>();
    {
      const std::lock_guard lock(mutex_);
      waits_.push_back(wait);
    }
    HttpReply reply;
    if (name == "later") {
      reply.headers = {{"Added", "by a wrapper"}};
      reply.later = [] {
        HttpReply later;
        later.contentType = "text/plain";
        later.body = "the reply";
        return later;
      };
      reply.wait = wait;
    } else {
      reply.contentType = "text/event-stream";
      reply.stream = [wait, times = 0](const BodySink& sink) mutable -> std::shared_ptr<ReplyWait> {
        sink(times++ == 0 ? "begun " : "more ");
        return wait;
      };
    }
    return reply;
  }

  /// A client that has asked, and whose reply waits.
  FileDescriptor ask(PendingConnections& pending, const std::string& path) {
    const std::size_t before = count();
    SocketPair pair;
    EXPECT_TRUE(sendAll(pair.client.get(), "GET " + path + " HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
    pending.adopt({std::move(pair.server), {"client", {"client", "client"}}});
    while (count() == before) std::this_thread::sleep_for(1ms);
    return std::move(pair.client);
  }

  std::size_t count() {
    const std::lock_guard lock(mutex_);
    return waits_.size();
  }
  TestedWait& wait(std::size_t index) {
    const std::lock_guard lock(mutex_);
    return *waits_.at(index);
  }

  /// What the client gets until it has the words, or there is no more.
  static std::string receiveUntil(const FileDescriptor& client, std::string_view words) {
    std::string received;
    char bytes[4096];
    while (received.find(words) == std::string::npos) {
      const ssize_t got = ::recv(client.get(), bytes, sizeof bytes, 0);
      if (got <= 0) break;
      received.append(bytes, static_cast<std::size_t>(got));
    }
    return received;
  }

  std::mutex mutex_;
  std::vector<std::shared_ptr<TestedWait>> waits_;
};

TEST_F(WaitingRepliesTest, HoldNoThread) {
  const auto pending = enter(); // of two threads
  std::vector<FileDescriptor> clients;
  for (int i = 0; i < 20; ++i) clients.push_back(ask(*pending, i % 2 == 0 ? "/later" : "/events"));
  ASSERT_TRUE(sendAll(client_.get(), "GET /none HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", Pace{}));
  EXPECT_TRUE(readAll().starts_with("HTTP/1.1 200 OK"));
  for (std::size_t i = 0; i < waits_.size(); ++i) {
    wait(i).put({.next = i % 2 == 0 ? ReplyWait::Next::thread : ReplyWait::Next::end});
  }
  EXPECT_TRUE(has(receiveUntil(clients[18], "the reply"), "Added: by a wrapper\r\n"));
  EXPECT_TRUE(has(receiveUntil(clients[19], "no such words"), "begun "));
}

TEST_F(WaitingRepliesTest, TheirConnectionsServeFurtherRequests) {
  const auto pending = enter();
  const FileDescriptor client = ask(*pending, "/later");
  wait(0).put({.next = ReplyWait::Next::thread});
  EXPECT_TRUE(has(receiveUntil(client, "the reply"), "Connection: keep-alive\r\n"));
  ASSERT_TRUE(sendAll(client.get(), "GET /none HTTP/1.1\r\nHost: x\r\n\r\n", Pace{}));
  EXPECT_TRUE(has(receiveUntil(client, "GET 1"), "HTTP/1.1 200 OK"));
}

TEST_F(WaitingRepliesTest, AStreamGoesOnByItselfAndWithAThread) {
  const auto pending = enter();
  const FileDescriptor client = ask(*pending, "/events");
  receiveUntil(client, "begun ");
  wait(0).put({.text = "news "});
  EXPECT_EQ(receiveUntil(client, "news "), "news ");
  wait(0).put({.next = ReplyWait::Next::thread});
  EXPECT_EQ(receiveUntil(client, "more "), "more ");
  wait(0).put({.text = "last", .next = ReplyWait::Next::end});
  EXPECT_EQ(receiveUntil(client, "no such words"), "last") << "and the connection ends";
}

TEST_F(WaitingRepliesTest, NewsIsSentWhenItComesHoweverManyWait) {
  context_.limits.look = 1h; // nothing else wakes it
  const auto pending = enter();
  std::vector<FileDescriptor> clients;
  for (int i = 0; i < 20; ++i) clients.push_back(ask(*pending, "/events"));
  receiveUntil(clients[7], "begun ");
  for (int i = 0; i < 20; ++i) {
    wait(7).put({.text = "news "});
    ASSERT_EQ(receiveUntil(clients[7], "news "), "news ");
  }
}

TEST_F(WaitingRepliesTest, AClientThatLeavesOrTakesNothingIsLetGo) {
  context_.limits.pace.most = 100ms;
  const auto pending = enter();
  FileDescriptor gone = ask(*pending, "/later");
  FileDescriptor goneToo = ask(*pending, "/events");
  const FileDescriptor asleep = ask(*pending, "/events");
  const FileDescriptor silent = ask(*pending, "/later"); // sends no more, but waits
  ::shutdown(silent.get(), SHUT_WR);
  gone.reset();
  goneToo.reset();
  wait(2).put({.text = std::string(8 << 20, 'x')});
  for (const auto end = Clock::now() + 10s; Clock::now() < end;) {
    std::this_thread::sleep_for(5ms);
    const std::lock_guard lock(mutex_);
    if (waits_[0].use_count() + waits_[1].use_count() + waits_[2].use_count() == 3) break;
  }
  EXPECT_EQ(waits_[0].use_count(), 1);
  EXPECT_EQ(waits_[1].use_count(), 1);
  EXPECT_EQ(waits_[2].use_count(), 1);
  wait(3).put({.next = ReplyWait::Next::thread});
  EXPECT_TRUE(has(receiveUntil(silent, "the reply"), "HTTP/1.1 200 OK"));
}

TEST_F(WaitingRepliesTest, AServerThatEndsWaitsForThemUntilItIsCutOff) {
  auto pending = enter();
  const FileDescriptor client = ask(*pending, "/events");
  std::thread cutting([&] {
    std::this_thread::sleep_for(100ms);
    context_.cutReplies.raise();
  });
  const auto start = Clock::now();
  pending->finish();
  EXPECT_GE(Clock::now() - start, 90ms);
  cutting.join();
}

} // namespace
} // namespace gnomon
