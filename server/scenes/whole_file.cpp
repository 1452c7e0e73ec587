#include "server/scenes/whole_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <dirent.h>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <random>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

using FileTime = std::chrono::system_clock::time_point;

FileTime lastUse(const struct stat& status) {
  const auto time = std::chrono::seconds(status.st_mtim.tv_sec) + std::chrono::nanoseconds(status.st_mtim.tv_nsec);
  return FileTime(std::chrono::duration_cast<FileTime::duration>(time));
}

bool isOlder(const struct stat& status, std::chrono::milliseconds age) {
  return lastUse(status) < std::chrono::system_clock::now() - age;
}

/// A process that removes a file holds it locked for some microseconds. Where locks are refused for longer, or are not
/// known, the file is used without one.
void lockShared(int fd) {
  constexpr int kTries = 50;
  for (int i = 0; i < kTries && ::flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// For an exclusive lock, which NFS gives on what may be written only.
FileDescriptor openToLock(const std::string& path) {
  FileDescriptor file = openRegular(path, O_RDWR);
  return file || errno != EACCES ? std::move(file) : openRegular(path, O_RDONLY);
}

/// A file that has not been used for so long, locked: no reader can begin to use it. Empty where it is none.
FileDescriptor lockUnused(const std::string& path, std::chrono::seconds age) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode) || !isOlder(status, age)) return {};
  FileDescriptor file = openToLock(path);
  if (!file || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0) return {};
  // A reader may have begun to use it before the lock.
  if (::fstat(file.get(), &status) != 0 || status.st_nlink == 0 || !isOlder(status, age)) return {};
  return file;
}

constexpr std::string_view kTemporary = ".writing-";

/// Appends all that `produce` makes, through to the disk; false when the disk refuses.
bool writeThrough(const FileDescriptor& file, const std::function<void(const FileSink&)>& produce) {
  bool good = true;
  produce([&](std::span<const std::uint8_t> bytes) { good = good && writeAll(file, bytes); });
  return good && ::fsync(file.get()) == 0;
}

/// A file of its own among all threads, processes and machines that write into the directory.
struct Temporary {
  std::string path;
  FileDescriptor file; ///< empty, with errno, where the disk refuses
};

Temporary makeTemporary(const std::filesystem::path& directory) {
  std::random_device random;
  while (true) {
    std::array<std::uint8_t, 8> bytes;
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random()); });
    std::string path = directory / (std::string(kTemporary) + hexText(bytes));
    FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0640));
    if (file) ::flock(file.get(), LOCK_EX | LOCK_NB); // until it is closed: its writer lives
    if (file || errno != EEXIST) return {std::move(path), std::move(file)};
  }
}

} // namespace

FileDescriptor openUsed(const std::string& path, std::chrono::milliseconds resolution) {
  constexpr int kTries = 3; // one that was removed between open and lock may be there again
  for (int i = 0; i < kTries; ++i) {
    FileDescriptor file = openRegular(path, O_RDONLY);
    if (!file) return file;
    lockShared(file.get());
    struct stat status {};
    if (::fstat(file.get(), &status) != 0 || status.st_nlink == 0) continue;
    if (isOlder(status, resolution)) ::futimens(file.get(), nullptr);
    return file;
  }
  errno = ENOENT;
  return {};
}

bool isUnused(const std::string& path, std::chrono::seconds age) {
  return static_cast<bool>(lockUnused(path, age));
}

bool removeIfUnused(const std::string& path, std::chrono::seconds age) {
  const FileDescriptor file = lockUnused(path, age);
  return file && ::unlink(path.c_str()) == 0;
}

bool placeFile(const std::string& path, const std::function<void(const FileSink&)>& produce) {
  const Temporary temporary = makeTemporary(std::filesystem::path(path).parent_path());
  if (!temporary.file) return false;
  if (writeThrough(temporary.file, produce) && ::rename(temporary.path.c_str(), path.c_str()) == 0) return true;
  const int reason = errno;
  ::unlink(temporary.path.c_str());
  errno = reason;
  return false;
}

bool syncDirectory(const std::string& path) {
  const FileDescriptor directory(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return directory && ::fsync(directory.get()) == 0;
}

std::optional<Bytes> readWhole(const std::string& path, std::size_t most) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)); // a pipe waits for its writer
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<std::size_t>(status.st_size) > most) {
    return std::nullopt;
  }
  Bytes bytes(static_cast<std::size_t>(status.st_size));
  if (!readAt(file, 0, bytes)) return std::nullopt;
  return bytes;
}

void removeUnfinished(const std::string& directory) {
  constexpr std::chrono::minutes kAge(1); // between a file's beginning and its lock, and where locks are not known
  eachName(directory, [&](std::string_view name) {
    if (name.starts_with(kTemporary)) removeIfUnused((directory + "/").append(name), kAge);
  });
}

bool eachName(const std::string& folder, const std::function<void(std::string_view name)>& visit) {
  const auto close = [](DIR* open) { ::closedir(open); };
  std::unique_ptr<DIR, decltype(close)> open(::opendir(folder.c_str()), close);
  if (!open) return false;
  while (true) {
    errno = 0;
    const dirent* const entry = ::readdir(open.get());
    if (entry == nullptr) break;
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") visit(name);
  }
  const int reason = errno;
  open.reset();
  errno = reason;
  return reason == 0;
}

} // namespace gnomon
