#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

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
  Bytes file_;
  std::string directory_;
  std::size_t files_ = 0;
};

} // namespace gnomon
