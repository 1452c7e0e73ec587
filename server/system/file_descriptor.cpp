#include "server/system/file_descriptor.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <linux/magic.h>
#include <memory>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE; ///< no byte can change or go

/// Pages that the kernel holds for a moment, to move them, make F_SEAL_WRITE fail with EBUSY.
bool seal(int fd) {
  constexpr int kTries = 10;
  for (int tries = 0; tries < kTries; ++tries) {
    if (::fcntl(fd, F_ADD_SEALS, kSeals | F_SEAL_SEAL) == 0) return true;
    if (errno != EBUSY) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(tries + 1));
  }
  return false;
}

/// A sealed file that is all in memory: what maps it never meets a page that is gone or can't be had.
bool isWhole(int fd, const struct stat& status) {
  constexpr blkcnt_t kBlock = 512; // stat(2), whatever the file system
  struct statfs system {};
  const int seals = ::fcntl(fd, F_GET_SEALS); // -1 for what is no memory file
  return S_ISREG(status.st_mode) && seals >= 0 && (seals & kSeals) == kSeals && status.st_blocks >= 0 &&
         status.st_size <= status.st_blocks * kBlock && ::fstatfs(fd, &system) == 0 && system.f_type == TMPFS_MAGIC;
}

std::optional<SharedBytes> mapped(const FileDescriptor& file, std::size_t size) {
  void* const bytes = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (bytes == MAP_FAILED) return std::nullopt;
  return SharedBytes(std::shared_ptr<const void>(bytes, [size](void* begin) { ::munmap(begin, size); }),
                     {static_cast<const char*>(bytes), size});
}

} // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    reset();
    fd_ = other.release();
  }
  return *this;
}

int FileDescriptor::release() {
  return std::exchange(fd_, -1);
}

void FileDescriptor::reset() {
  if (fd_ >= 0) ::close(release());
}

void fillStandardDescriptors() {
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const bool isClosed = ::fcntl(standard, F_GETFD) < 0 && errno == EBADF;
    if (isClosed && ::open("/dev/null", O_RDWR) != standard) ::_exit(1); // the lowest that is free
  }
}

StopSignal::StopSignal() : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

void StopSignal::raise() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(event_.get(), &one, sizeof one);
}

void StopSignal::lower() noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto read = ::read(event_.get(), &count, sizeof count);
}

bool StopSignal::waitFor(std::chrono::milliseconds patience) const {
  pollfd waiting{event_.get(), POLLIN, 0};
  return ::poll(&waiting, 1, static_cast<int>(patience.count())) == 1;
}

MemoryFileWriter::MemoryFileWriter()
    : file_(::memfd_create("gnomon", MFD_CLOEXEC | MFD_ALLOW_SEALING)), whole_(bool(file_)) {}

void MemoryFileWriter::add(std::span<const std::uint8_t> bytes) {
  whole_ = whole_ && writeAll(file_, bytes);
}

std::optional<FileDescriptor> MemoryFileWriter::finish() {
  if (!whole_ || !seal(file_.get())) return std::nullopt;
  whole_ = false;
  return std::move(file_);
}

std::optional<FileDescriptor> memoryFile(std::span<const std::uint8_t> bytes) {
  MemoryFileWriter writer;
  writer.add(bytes);
  return writer.finish();
}

std::optional<SharedBytes> sealedBytes(const FileDescriptor& file, std::size_t most) {
  constexpr std::size_t kSmall = 256 * 1024; // a process may have some 65,000 mappings
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || status.st_size < 0 || !isWhole(file.get(), status)) return std::nullopt;
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most) return std::nullopt;
  if (size > kSmall) return mapped(file, size);
  auto bytes = readText(file, size);
  return bytes ? std::optional<SharedBytes>(*std::move(bytes)) : std::nullopt;
}

FileDescriptor openRegular(const std::string& path, int flags) {
  FileDescriptor file(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  if (!file && errno != ELOOP && errno != ENXIO) return file; // those are links and sockets
  if (file && ::fstat(file.get(), &status) != 0) return {};
  if (file && S_ISREG(status.st_mode)) return file;
  errno = ENOENT;
  return {};
}

std::optional<std::size_t> sizeOf(const FileDescriptor& file) {
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || status.st_size < 0) return std::nullopt;
  return static_cast<std::size_t>(status.st_size);
}

bool readAt(const FileDescriptor& file, std::uint64_t offset, std::span<std::uint8_t> room) {
  while (!room.empty()) {
    const ssize_t count = ::pread(file.get(), room.data(), room.size(), static_cast<off_t>(offset));
    if (count == 0 || (count < 0 && errno != EINTR)) return false;
    if (count < 0) continue;
    room = room.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return true;
}

bool eachPiece(const FileDescriptor& file, const std::function<void(std::span<const std::uint8_t>)>& take) {
  constexpr std::size_t kPiece = 1 << 20;
  const auto size = sizeOf(file);
  if (!size) return false;
  Bytes piece(std::min(kPiece, *size));
  for (std::size_t at = 0; at < *size; at += piece.size()) {
    const auto room = std::span(piece).first(std::min(piece.size(), *size - at));
    if (!readAt(file, at, room)) return false;
    take(room);
  }
  return true;
}

bool writeAll(const FileDescriptor& file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file.get(), bytes.data(), bytes.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return false;
    if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

std::optional<Bytes> readFile(const FileDescriptor& file, std::size_t most) {
  const auto size = sizeOf(file);
  if (!size || *size > most) return std::nullopt;
  Bytes bytes(*size);
  return readAt(file, 0, bytes) ? std::optional(std::move(bytes)) : std::nullopt;
}

std::optional<std::string> readText(const FileDescriptor& file, std::size_t most) {
  const auto size = sizeOf(file);
  if (!size || *size > most) return std::nullopt;
  std::string text(*size, '\0');
  const std::span room(reinterpret_cast<std::uint8_t*>(text.data()), text.size());
  return readAt(file, 0, room) ? std::optional(std::move(text)) : std::nullopt;
}

} // namespace gnomon
