#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/zip.h"

namespace gnomon {

/// A ZIP that is sent while it is made: each file's bytes follow its head at once, stored as they are, and only the
/// directory, some hundred bytes a file, is kept for the end. Larger than 4 GB and with more than 65,535 files as
/// ZIP64.
class ZipStream {
 public:
  /// What is sent before the bytes of a file. REQUIRES: `name` is ASCII.
  std::string head(std::string_view name, std::uint32_t size, std::uint32_t crc32) {
    const ZipFile file{.name = name, .crc32 = crc32, .bytes = size, .packedBytes = size};
    std::string text = zipHead(file);
    directory_ += zipDirectoryEntry(file, offset_);
    ++files_;
    offset_ += text.size() + size;
    return text;
  }

  /// What is sent after the last file.
  std::string end() const { return directory_ + zipEnd(files_, directory_.size(), offset_); }

 private:
  std::string directory_;
  std::uint64_t files_ = 0;
  std::uint64_t offset_ = 0; ///< of what comes next
};

} // namespace gnomon
