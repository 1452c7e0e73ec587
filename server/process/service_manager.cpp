#include "server/process/service_manager.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <netdb.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/time.h>
#include <systemd/sd-daemon.h>

namespace gnomon {
namespace {

using std::chrono::microseconds;

void limitWaits(int fd, std::chrono::milliseconds patience) {
  const timeval most{patience.count() / 1000, patience.count() % 1000 * 1000};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  ::setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &most, sizeof most); // of connect(), too
}

bool answersLivez(const addrinfo& address, std::chrono::milliseconds patience) {
  constexpr std::string_view kRequest = "GET /livez HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  constexpr std::string_view kGood = "HTTP/1.1 200 ";
  const FileDescriptor socket(::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket) return false;
  limitWaits(socket.get(), patience);
  if (::connect(socket.get(), address.ai_addr, address.ai_addrlen) != 0) return false;
  if (::send(socket.get(), kRequest.data(), kRequest.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(kRequest.size())) {
    return false;
  }
  std::array<char, kGood.size()> begin{};
  const ssize_t count = ::recv(socket.get(), begin.data(), begin.size(), MSG_WAITALL);
  return count > 0 && std::string_view(begin.data(), static_cast<std::size_t>(count)) == kGood;
}

} // namespace

bool hasServiceManager() {
  return std::getenv("NOTIFY_SOCKET") != nullptr;
}

void tellReady(const std::string& status) {
  ::sd_notify(0, ("READY=1\nSTATUS=" + status).c_str());
}

void tellReloading() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t microsecondsNow = now.tv_sec * 1'000'000 + now.tv_nsec / 1000;
  ::sd_notify(0, ("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(microsecondsNow)).c_str());
}

void tellStopping(std::chrono::seconds needed) {
  ::sd_notify(0, ("STOPPING=1\nSTATUS=The server is shutting down.\nEXTEND_TIMEOUT_USEC=" +
                  std::to_string(microseconds(needed).count()))
                     .c_str());
}

bool answersLivez(const std::string& bind, int port, std::chrono::milliseconds patience) {
  const std::string host = bind == "0.0.0.0" ? "127.0.0.1" : bind == "::" ? "::1" : bind;
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return false;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    if (answersLivez(*each, patience)) return true;
  }
  return false;
}

Watchdog::Watchdog(std::function<bool(std::chrono::milliseconds patience)> isWell) {
  constexpr std::chrono::milliseconds kLongest{2'000}; // the process's end may have to wait for it
  std::uint64_t allowed = 0;                           // microseconds
  if (::sd_watchdog_enabled(0, &allowed) <= 0) return;
  const auto period = std::chrono::duration_cast<std::chrono::milliseconds>(microseconds(allowed / 3));
  thread_ = std::thread([this, isWell = std::move(isWell), period, kLongest] {
    do {
      if (isWell(std::min(period, kLongest))) ::sd_notify(0, "WATCHDOG=1");
    } while (!stop_.waitFor(period));
  });
}

Watchdog::~Watchdog() {
  stop_.raise();
  if (thread_.joinable()) thread_.join();
}

} // namespace gnomon
