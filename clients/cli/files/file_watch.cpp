#include "clients/cli/files/file_watch.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

namespace gnomon::cli {
namespace {

constexpr int kQuietMilliseconds = 50; // after which a burst of changes is over
constexpr std::uint32_t kChanges = IN_CLOSE_WRITE | IN_MOVED_TO | IN_DELETE | IN_MOVED_FROM;

Problem systemProblem(const std::string& where, const char* detail) {
  return {ProblemCode::internal, where, std::string(detail) + ": " + std::strerror(errno) + "."};
}

} // namespace

Result<FileWatch> FileWatch::create() {
  sigset_t ends;
  ::sigemptyset(&ends);
  ::sigaddset(&ends, SIGINT);
  ::sigaddset(&ends, SIGTERM);
  if (::pthread_sigmask(SIG_BLOCK, &ends, nullptr) != 0) return systemProblem("", "Signals can't be held back");
  const int events = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  if (events < 0) return systemProblem("", "Files can't be watched");
  const int signals = ::signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK);
  if (signals >= 0) return FileWatch(events, signals);
  ::close(events);
  return systemProblem("", "Signals can't be awaited");
}

FileWatch::FileWatch(FileWatch&& other) noexcept
    : events_(std::exchange(other.events_, -1)),
      signals_(std::exchange(other.signals_, -1)),
      folders_(std::move(other.folders_)),
      names_(std::move(other.names_)) {}

FileWatch::~FileWatch() {
  if (events_ >= 0) ::close(events_);
  if (signals_ >= 0) ::close(signals_);
}

Status FileWatch::watch(const std::vector<std::filesystem::path>& files) {
  std::set<std::pair<int, std::string>> names;
  for (const std::filesystem::path& file : files) {
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    // Adding a folder that is watched gives its number again.
    const int number = ::inotify_add_watch(events_, folder.c_str(), kChanges);
    if (number < 0) return systemProblem(folder, "The folder can't be watched");
    folders_[folder] = number;
    names.emplace(number, file.filename().string());
  }
  names_ = std::move(names);
  return Done{};
}

bool FileWatch::wait() {
  Wake wake = next(-1);
  while (wake == Wake::nothing) wake = next(-1);
  while (wake == Wake::file) wake = next(kQuietMilliseconds);
  return wake != Wake::signal;
}

FileWatch::Wake FileWatch::next(int milliseconds) {
  std::array<pollfd, 2> waits{pollfd{signals_, POLLIN, 0}, pollfd{events_, POLLIN, 0}};
  if (::poll(waits.data(), waits.size(), milliseconds) <= 0) return Wake::nothing;
  if (waits[0].revents != 0) return Wake::signal;
  return readEvents() ? Wake::file : Wake::nothing;
}

/// Whether one of the events is about a file that is watched.
bool FileWatch::readEvents() {
  alignas(inotify_event) std::array<char, 1 << 14> buffer{};
  bool isOurs = false;
  for (ssize_t size = 0; (size = ::read(events_, buffer.data(), buffer.size())) > 0;) {
    for (ssize_t at = 0; at < size;) {
      inotify_event event{};
      std::memcpy(&event, buffer.data() + at, sizeof event);
      const char* name = buffer.data() + at + sizeof event;
      const bool isLost = (event.mask & IN_Q_OVERFLOW) != 0; // a change was lost
      if (isLost || (event.len > 0 && names_.contains({event.wd, name}))) isOurs = true;
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
  }
  return isOurs;
}

} // namespace gnomon::cli
