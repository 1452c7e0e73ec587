#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace gnomon::testing {

/// What a test is to do, read from bytes one choice after the other. Any bytes will do: where they end, each choice is
/// its first.
class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }

  /// 0 .. count - 1. REQUIRES: count is 1 .. 256.
  int below(int count) { return byte() % count; }

  /// First false.
  bool oneIn(int count) { return below(count) == count - 1; }

  template <class T>
  T of(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<int>(values.size()))];
  }

  /// One of 65,536 values from `first` to `last`.
  double within(double first, double last) {
    const int step = byte() << 8 | byte();
    return first + (last - first) * step / 65535;
  }

  /// The same, every factor as likely as any other. REQUIRES: both are more than 0.
  double factor(double first, double last) { return std::exp(within(std::log(first), std::log(last))); }

 private:
  std::span<const std::uint8_t> bytes_;
};

} // namespace gnomon::testing
