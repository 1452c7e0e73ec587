#include "server/process/signals.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

namespace gnomon {

Signals::Signals(std::function<void()> onHangup, FileDescriptor starter)
    : onHangup_(std::move(onHangup)), starter_(std::move(starter)) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signals_ = FileDescriptor(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

Signals::Event Signals::wait(const StopSignal& done, Clock::time_point deadline) {
  while (true) {
    std::array<pollfd, 3> waiting{
        {{signals_.get(), POLLIN, 0}, {done.fd(), POLLIN, 0}, {starter_.get(), POLLIN, 0}}}; // poll(2) skips -1
    ::poll(waiting.data(), waiting.size(), millisecondsUntil(deadline));
    if (waiting[1].revents != 0) return Event::done;
    signalfd_siginfo info{};
    if (waiting[0].revents != 0 && ::read(signals_.get(), &info, sizeof info) == sizeof info) {
      if (info.ssi_signo != SIGHUP) return Event::signal;
      onHangup_();
    }
    if (waiting[2].revents != 0 && starterIsGone()) {
      starter_.reset();
      return Event::abandoned;
    }
    if (Clock::now() >= deadline) return Event::timeout;
  }
}

bool Signals::starterIsGone() {
  std::array<char, 4096> dropped;
  const ssize_t count = ::read(starter_.get(), dropped.data(), dropped.size());
  return count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN);
}

} // namespace gnomon
