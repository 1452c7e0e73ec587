#include "server/http/overflow_lane.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "server/http/reply.h"
#include "server/http/request_log.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxClients = 512;
constexpr std::chrono::milliseconds kPatience{1'000}; ///< for a head, and again for the client to close
constexpr int kRetryAfterSeconds = 1;

void drain(int eventFd) {
  std::array<char, 8> count;
  [[maybe_unused]] const auto read = ::read(eventFd, count.data(), count.size());
}

} // namespace

OverflowLane::OverflowLane(ConnectionContext& context) : context_(context), thread_([this] { watch(); }) {}

OverflowLane::~OverflowLane() {
  stopping_ = true;
  wake_.raise();
  thread_.join();
}

void OverflowLane::adopt(FileDescriptor socket) noexcept {
  try {
    const std::lock_guard lock(mutex_);
    if (count_ < kMaxClients) {
      adopted_.push_back(std::move(socket));
      ++count_;
    }
  } catch (const std::exception& error) {
    logEvent("overflow", error.what());
  }
  wake_.raise();
}

void OverflowLane::takeAdopted(std::vector<Client>& clients) {
  const std::lock_guard lock(mutex_);
  for (FileDescriptor& socket : adopted_) {
    clients.push_back({std::move(socket), "", Clock::now() + kPatience});
  }
  adopted_.clear();
  count_ = clients.size();
}

void OverflowLane::watch() {
  std::vector<Client> clients;
  std::vector<pollfd> waiting;
  while (!stopping_) {
    takeAdopted(clients);
    waiting.assign(1, {wake_.fd(), POLLIN, 0});
    auto next = Clock::now() + std::chrono::hours(1);
    for (const Client& client : clients) {
      waiting.push_back({client.socket.get(), POLLIN, 0});
      next = std::min(next, client.deadline);
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
    ::poll(waiting.data(), waiting.size(), static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (waiting[0].revents != 0) {
      drain(wake_.fd());
    }
    std::vector<Client> staying;
    for (std::size_t i = 0; i < clients.size(); ++i) {
      if (stays(clients[i], waiting[i + 1].revents)) {
        staying.push_back(std::move(clients[i]));
      }
    }
    clients = std::move(staying);
  }
}

bool OverflowLane::stays(Client& client, short events) {
  if (Clock::now() >= client.deadline) {
    return false;
  }
  if (events == 0) {
    return true;
  }
  std::array<char, 4096> bytes;
  const ssize_t count = ::recv(client.socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count <= 0) {
    return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  }
  if (client.answered) {
    return true;
  }
  client.received.append(bytes.data(), static_cast<std::size_t>(count));
  if (const auto length = headLength(client.received)) {
    answer(client, *length);
    return true;
  }
  return client.received.size() < kMaxHeadBytes;
}

void OverflowLane::answer(Client& client, std::size_t headBytes) {
  RequestRecord record;
  HttpReply reply;
  bool bodyless = false;
  try {
    const auto head = parseRequestHead(std::string_view(client.received).substr(0, headBytes));
    auto request = head ? requestFromHead(*head) : Result<HttpRequest>(head.problems());
    if (!request) {
      reply = problemReply(request.problems(), record.id, {.read = RequestPart::head});
    } else {
      record.id = request->id;
      record.method = request->method;
      record.target = head->target;
      bodyless = request->method == "HEAD";
      auto found = context_.service(*request);
      const auto* handler = std::get_if<RequestHandler>(&found);
      if (handler != nullptr && handler->isProbe) {
        reply = handler->answer(*std::move(request), [] { return false; });
      } else {
        reply = problemReply(
            {{ProblemCode::unavailable, "", "The server already serves as many connections as it can.", "", ""}},
            record.id);
        reply.headers.emplace_back("Retry-After", std::to_string(kRetryAfterSeconds));
      }
    }
    std::string text = replyHead(reply, record.id, false);
    if (!bodyless) {
      text += reply.body;
    }
    record.delivered = sendAll(client.socket.get(), text, Clock::now()); // it fits the socket's buffer, or is dropped
    ::shutdown(client.socket.get(), SHUT_WR);
    logRequest(record, reply);
  } catch (const std::exception& error) {
    logEvent("overflow", error.what());
  }
  client.answered = true;
  client.deadline = Clock::now() + kPatience;
}

} // namespace gnomon
