#include "renderer/scene/decode/decode_budget.h"

namespace gnomon {

bool DecodeBudget::take(std::uint64_t bytes, const std::string& pointer, Findings& findings) {
  if (bytes > left()) {
    findings.tooLarge(pointer, "The compressed data comes to too many bytes.", std::to_string(limit_) + " bytes",
                      std::to_string(bytes) + " bytes after " + std::to_string(used_));
    return false;
  }
  used_ += bytes;
  return true;
}

} // namespace gnomon
