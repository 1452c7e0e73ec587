#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// What errno `reason` says of such a file, which the log gets too: insufficientStorage, or `otherwise`.
Problem refusedByDisk(int reason, ProblemCode otherwise);

/// A file without a name, which goes with its process: in a directory, or in memory where that is empty. Any thread.
class ResultFile {
 public:
  /// A problem, also in the log, where the disk, or memory, refuses: insufficientStorage or unavailable.
  static Result<std::shared_ptr<ResultFile>> make(const std::string& directory);

  explicit ResultFile(FileDescriptor file) : file_(std::move(file)) {}

  /// Where the bytes are now. A problem, also in the log, where the disk, or memory, refuses: insufficientStorage, or
  /// internal.
  Result<std::uint64_t> add(std::span<const std::uint8_t> bytes);

  /// Bytes that were added; nothing where they can't be read.
  std::optional<Bytes> read(std::uint64_t offset, std::size_t size) const;

 private:
  FileDescriptor file_;
  std::atomic<std::uint64_t> end_ = 0;
};

} // namespace gnomon
