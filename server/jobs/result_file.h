#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/base/bytes.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// A file without a name, which goes with its process: in a directory, or in memory where that is empty. Any thread.
class ResultFile {
 public:
  explicit ResultFile(const std::string& directory);

  /// Where the bytes are now; nothing where the disk, or memory, refuses.
  std::optional<std::uint64_t> add(std::span<const std::uint8_t> bytes);

  /// Bytes that were added; nothing where they can't be read.
  std::optional<Bytes> read(std::uint64_t offset, std::size_t size) const;

 private:
  FileDescriptor file_;
  std::atomic<std::uint64_t> end_ = 0;
};

} // namespace gnomon
