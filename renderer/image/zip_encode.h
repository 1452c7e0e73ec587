#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

namespace gnomon {

/// A ZIP, file by file: each deflated by all cores, or stored where that is smaller, with a pinned time, so that equal
/// files give equal bytes. Without the extension for 4 GiB and more (ZIP64).
class ZipWriter {
 public:
  /// `name`: ASCII, none twice. A problem of code tooLarge where the ZIP would need ZIP64.
  Status add(std::string_view name, std::span<const std::uint8_t> content);

  /// The whole; the last call.
  Result<Bytes> finish() &&;

 private:
  struct Entry {
    std::string name;
    std::uint32_t checksum = 0; ///< CRC-32 of the content
    std::uint32_t packedBytes = 0;
    std::uint32_t bytes = 0;
    std::uint32_t offset = 0; ///< of its header in the file
    bool deflated = false;
  };

  Bytes file_;
  std::vector<Entry> entries_;
};

} // namespace gnomon
