#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/base/bytes.h"

namespace gnomon {

/// Bytes that never change. Copies share them, so that what is kept or drawn once is sent to many clients from one
/// place.
class SharedBytes {
 public:
  SharedBytes() = default;
  SharedBytes(std::string bytes) : SharedBytes(std::make_shared<const std::string>(std::move(bytes))) {}
  SharedBytes(std::string_view bytes) : SharedBytes(std::string(bytes)) {}
  SharedBytes(const char* text) : SharedBytes(std::string(text)) {}
  SharedBytes(Bytes bytes) : SharedBytes(std::make_shared<const Bytes>(std::move(bytes))) {}

  /// Bytes that are there as long as `owner` is.
  SharedBytes(std::shared_ptr<const void> owner, std::string_view bytes) : owner_(std::move(owner)), bytes_(bytes) {}

  std::string_view view() const { return bytes_; }
  operator std::string_view() const { return bytes_; }
  std::span<const std::uint8_t> bytes() const { return asBytes(bytes_); }
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }

  friend bool operator==(const SharedBytes& a, std::string_view b) { return a.view() == b; }

 private:
  explicit SharedBytes(std::shared_ptr<const std::string> text) : owner_(text), bytes_(*text) {}
  explicit SharedBytes(std::shared_ptr<const Bytes> bytes) : owner_(bytes), bytes_(asText(*bytes)) {}

  std::shared_ptr<const void> owner_;
  std::string_view bytes_;
};

} // namespace gnomon
