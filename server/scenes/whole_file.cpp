#include "server/scenes/whole_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "server/system/file_descriptor.h"

namespace gnomon {
namespace {

constexpr std::string_view kTemporary = ".writing-";

/// Calls `produce` with a function that appends to the file; false when the disk refuses.
bool writeThrough(const std::string& path, const std::function<void(const FileSink&)>& produce) {
  const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0640));
  bool good = static_cast<bool>(file);
  produce([&](std::span<const std::uint8_t> bytes) {
    while (good && !bytes.empty()) {
      const ssize_t count = ::write(file.get(), bytes.data(), bytes.size());
      if (count > 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(count));
      } else {
        good = count < 0 && errno == EINTR;
      }
    }
  });
  return good && ::fsync(file.get()) == 0;
}

/// Unique among the threads and processes that write into the directory.
std::string temporaryName() {
  static std::atomic<std::uint64_t> count{0};
  return std::string(kTemporary) + std::to_string(::getpid()) + "-" + std::to_string(++count);
}

} // namespace

bool placeFile(const std::string& path, const std::function<void(const FileSink&)>& produce) {
  const std::string temporary = std::filesystem::path(path).parent_path() / temporaryName();
  if (writeThrough(temporary, produce) && ::rename(temporary.c_str(), path.c_str()) == 0) {
    return true;
  }
  const int reason = errno;
  ::unlink(temporary.c_str());
  errno = reason;
  return false;
}

std::optional<Bytes> readWhole(const std::string& path, std::size_t most) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<std::size_t>(status.st_size) > most) {
    return std::nullopt;
  }
  Bytes bytes(static_cast<std::size_t>(status.st_size));
  std::size_t read = 0;
  while (read < bytes.size()) {
    const ssize_t count = ::read(file.get(), bytes.data() + read, bytes.size() - read);
    if (count > 0) {
      read += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      return std::nullopt;
    }
  }
  return bytes;
}

void removeUnfinished(const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with(kTemporary)) {
      std::error_code ignored; // another process may be removing it too
      fs::remove(entry->path(), ignored);
    }
  }
}

} // namespace gnomon
