#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "protocol/base/bytes.h"
#include "server/system/shared_bytes.h"

namespace gnomon {

/// Owns a file descriptor.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  ~FileDescriptor() { reset(); }
  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  int release();
  void reset();

 private:
  int fd_ = -1;
};

/// Opens /dev/null as each of the descriptors 0 to 2 that is closed, so that no file or socket of this process becomes
/// one of them, which are read, written and passed on as standard streams. To be called before anything is opened.
void fillStandardDescriptors();

/// A signal that many threads can wait for together with their sockets: its descriptor is readable once it is raised.
class StopSignal {
 public:
  StopSignal();
  void raise() noexcept;
  void lower() noexcept; ///< until it is raised again; for the one that waits for it
  bool raised() const { return waitFor(std::chrono::milliseconds(0)); }
  bool waitFor(std::chrono::milliseconds patience) const; ///< true once it is raised; false where that comes later
  int fd() const { return event_.get(); }

 private:
  FileDescriptor event_;
};

/// Bytes in memory behind a descriptor (memfd_create(2)), so that another process can be given them without a copy. The
/// memory is freed when the last descriptor is closed.
class MemoryFileWriter {
 public:
  MemoryFileWriter();

  /// Appends. Once the system has refused memory, nothing more is written.
  void add(std::span<const std::uint8_t> bytes);

  /// The file, sealed: no process can change or shorten it any more. Nothing where the system refused memory.
  std::optional<FileDescriptor> finish();

 private:
  FileDescriptor file_;
  bool whole_ = true;
};

std::optional<FileDescriptor> memoryFile(std::span<const std::uint8_t> bytes);

/// The bytes of a file that MemoryFileWriter has made, in whichever process: large ones where they are, without a copy.
/// Nothing where it is no memory file, may still change, is not in memory as a whole, or has more than `most` bytes.
std::optional<SharedBytes> sealedBytes(const FileDescriptor& file, std::size_t most);

/// Opens a regular file by its own name, and waits for nothing. Empty, with errno, where there is none: what else has
/// the name (a pipe, a device, a link) is ENOENT.
FileDescriptor openRegular(const std::string& path, int flags);

/// Fills `room` with the bytes from `offset` on; false where the file has fewer, or can't be read.
bool readAt(const FileDescriptor& file, std::uint64_t offset, std::span<std::uint8_t> room);

/// Calls with the bytes of a file, from its begin on, some at a time; false where they can't be read.
bool eachPiece(const FileDescriptor& file, const std::function<void(std::span<const std::uint8_t>)>& take);

/// Writes all bytes where the file's offset is; false, with errno, where the system refuses.
bool writeAll(const FileDescriptor& file, std::span<const std::uint8_t> bytes);

/// How many bytes a file has; nothing where that is unknown.
std::optional<std::size_t> sizeOf(const FileDescriptor& file);

/// All bytes of a file, from its begin on, wherever its offset is; nothing where there are more than `most`, or where
/// it can't be read.
std::optional<Bytes> readFile(const FileDescriptor& file, std::size_t most);
std::optional<std::string> readText(const FileDescriptor& file, std::size_t most); ///< the same, as text

} // namespace gnomon
