#include "server/scenes/file_use.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

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
  FileDescriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
  if (file || errno != EACCES) return file;
  return FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
}

} // namespace

FileDescriptor openUsed(const std::string& path, std::chrono::milliseconds resolution) {
  constexpr int kTries = 3; // one that was removed between open and lock may be there again
  for (int i = 0; i < kTries; ++i) {
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
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

bool removeIfUnused(const std::string& path, std::chrono::seconds age) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode) || !isOlder(status, age)) return false;
  const FileDescriptor file = openToLock(path);
  if (!file || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0) return false;
  // No reader can begin to use it now; but one may have, before the lock.
  if (::fstat(file.get(), &status) != 0 || status.st_nlink == 0 || !isOlder(status, age)) return false;
  return ::unlink(path.c_str()) == 0;
}

} // namespace gnomon
