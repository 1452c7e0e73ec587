#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gnomon {

/// A ZIP that is sent while it is made: each file's bytes follow its head at once, stored as they are, and only the
/// directory, some hundred bytes a file, is kept for the end. Larger than 4 GB and with more than 65,535 files as ZIP64
/// (APPNOTE.TXT 6.3.10, sections 4.3 and 4.5.3). Dates are the format's first one, so that equal files give equal
/// bytes.
class ZipStream {
 public:
  /// What is sent before the bytes of a file. REQUIRES: `name` is ASCII.
  std::string head(std::string_view name, std::uint32_t size, std::uint32_t crc32);

  /// What is sent after the last file.
  std::string end();

 private:
  std::string directory_;
  std::uint64_t files_ = 0;
  std::uint64_t offset_ = 0; ///< of what comes next
};

/// CRC-32 as ZIP and PNG have it.
std::uint32_t crc32Of(std::span<const std::uint8_t> bytes);

} // namespace gnomon
