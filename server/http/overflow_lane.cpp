#include "server/http/overflow_lane.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "server/http/problem_reply.h"
#include "server/http/reply_text.h"
#include "server/http/request_log.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxGuests = 512;
constexpr std::chrono::milliseconds kPatience{1'000}; ///< for a head, and again for the client to leave
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
    if (count_ < kMaxGuests) {
      newcomers_.push_back(std::move(socket));
      ++count_;
    }
  } catch (const std::exception& error) {
    logEvent("overflow", error.what());
  }
  wake_.raise();
}

void OverflowLane::takeNewcomers(std::vector<Guest>& guests) {
  const std::lock_guard lock(mutex_);
  for (FileDescriptor& socket : newcomers_) {
    guests.push_back({std::move(socket), "", Clock::now() + kPatience});
  }
  newcomers_.clear();
  count_ = guests.size();
}

void OverflowLane::watch() {
  std::vector<Guest> guests;
  std::vector<pollfd> waiting;
  while (!stopping_) {
    takeNewcomers(guests);
    waiting.assign(1, {wake_.fd(), POLLIN, 0});
    auto next = Clock::now() + std::chrono::hours(1);
    for (const Guest& guest : guests) {
      waiting.push_back({guest.socket.get(), POLLIN, 0});
      next = std::min(next, guest.deadline);
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
    ::poll(waiting.data(), waiting.size(), static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (waiting[0].revents != 0) {
      drain(wake_.fd());
    }
    std::vector<Guest> staying;
    for (std::size_t i = 0; i < guests.size(); ++i) {
      if (stays(guests[i], waiting[i + 1].revents)) {
        staying.push_back(std::move(guests[i]));
      }
    }
    guests = std::move(staying);
  }
}

bool OverflowLane::stays(Guest& guest, short events) {
  if (Clock::now() >= guest.deadline) {
    return false;
  }
  if (events == 0) {
    return true;
  }
  std::array<char, 4096> bytes;
  const ssize_t count = ::recv(guest.socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count <= 0) {
    return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  }
  if (guest.answered) {
    return true;
  }
  guest.received.append(bytes.data(), static_cast<std::size_t>(count));
  if (const auto length = headLength(guest.received)) {
    answer(guest, *length);
    return true;
  }
  return guest.received.size() < kMaxHeadBytes;
}

void OverflowLane::answer(Guest& guest, std::size_t headBytes) {
  RequestRecord record;
  HttpReply reply;
  bool bodyless = false;
  try {
    const auto head = parseRequestHead(std::string_view(guest.received).substr(0, headBytes));
    auto request = head ? requestFromHead(*head) : Result<HttpRequest>(head.problems());
    if (!request) {
      reply = problemReply(request.problems(), record.id, 400);
    } else {
      record.id = request->id;
      record.method = request->method;
      record.target = head->target;
      bodyless = request->method == "HEAD";
      if (context_.service.isProbe(*request)) {
        reply = context_.service.handle(*std::move(request), [] { return false; });
      } else {
        const Problem taken{ProblemCode::unavailable, "", "Every connection that this server can serve is taken.", "",
                            ""};
        reply = busyReply({taken}, record.id, kRetryAfterSeconds);
      }
    }
    std::string text = replyHead(reply, record.id, false);
    if (!bodyless) {
      text += reply.body;
    }
    record.delivered = sendAll(guest.socket.get(), text, Clock::now()); // it fits the socket's buffer, or is dropped
    ::shutdown(guest.socket.get(), SHUT_WR);
    logRequest(record, reply);
  } catch (const std::exception& error) {
    logEvent("overflow", error.what());
  }
  guest.answered = true;
  guest.deadline = Clock::now() + kPatience;
}

} // namespace gnomon
