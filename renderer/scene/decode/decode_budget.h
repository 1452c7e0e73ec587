#pragma once

#include <cstdint>
#include <string>

#include "renderer/scene/findings.h"

namespace gnomon {

/// Bytes that a file's compressed data may come to, counted before any of them is allocated.
class DecodeBudget {
 public:
  explicit DecodeBudget(std::uint64_t limit, std::uint64_t used = 0) : limit_(limit), used_(used) {}

  /// False, and a problem at `pointer`, where `bytes` more would pass the limit.
  bool take(std::uint64_t bytes, const std::string& pointer, Findings& findings) {
    if (bytes > left()) {
      findings.tooLarge(pointer, "The compressed data decodes to too many bytes.", std::to_string(limit_) + " bytes",
                        std::to_string(bytes) + " bytes after " + std::to_string(used_));
      return false;
    }
    used_ += bytes;
    return true;
  }

  std::uint64_t used() const { return used_; }
  std::uint64_t left() const { return limit_ - used_; }

 private:
  std::uint64_t limit_ = 0;
  std::uint64_t used_ = 0; ///< <= limit_
};

} // namespace gnomon
