#include "server/scenes/whole_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <dirent.h>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <random>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "protocol/base/bytes.h"
#include "server/scenes/file_use.h"
#include "server/system/file_descriptor.h"

namespace gnomon {
namespace {

constexpr std::string_view kTemporary = ".writing-";

/// Appends all that `produce` makes, through to the disk; false when the disk refuses.
bool writeThrough(const FileDescriptor& file, const std::function<void(const FileSink&)>& produce) {
  bool good = true;
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
  constexpr std::chrono::minutes kAge(1); // between a file's beginning and its lock, and where locks are not known
  eachName(directory, [&](std::string_view name) {
    if (name.starts_with(kTemporary)) removeIfUnused((directory + "/").append(name), kAge);
  });
}

void eachName(const std::string& folder, const std::function<void(std::string_view name)>& visit) {
  const auto close = [](DIR* open) { ::closedir(open); };
  const std::unique_ptr<DIR, decltype(close)> open(::opendir(folder.c_str()), close);
  if (!open) return;
  while (const dirent* entry = ::readdir(open.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") visit(name);
  }
}

} // namespace gnomon
