#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::codec {

/// A file that has a path and yet lies in memory. OpenImageIO 2.4 writes an EXR of several parts to paths only.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  bool valid() const { return descriptor_ >= 0; }

  /// Means this file in this process only, while it lives.
  std::string path() const;

  /// What was written so far, mapped until the file is destroyed. Call it once; empty where mapping fails.
  std::span<const std::uint8_t> contents();

 private:
  int descriptor_ = -1;
  void* mapped_ = nullptr;
  std::size_t mappedSize_ = 0;
};

} // namespace gnomon::codec
