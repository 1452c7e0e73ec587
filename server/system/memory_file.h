#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/base/bytes.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

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

/// How many bytes a file has; nothing where that is unknown.
std::optional<std::size_t> sizeOf(const FileDescriptor& file);

/// All bytes of a file, from its begin on, wherever its offset is; nothing where there are more than `most`, or where
/// it can't be read.
std::optional<Bytes> readFile(const FileDescriptor& file, std::size_t most);
std::optional<std::string> readText(const FileDescriptor& file, std::size_t most); ///< the same, as text

} // namespace gnomon
