#pragma once

#include <atomic>
#include <cstddef>

namespace gnomon {

/// Bytes that all requests together may hold. Any thread.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t bytes) : total_(bytes), left_(bytes) {}

  std::size_t total() const { return total_; }

  bool take(std::size_t bytes) {
    std::size_t left = left_.load();
    while (left >= bytes) {
      if (left_.compare_exchange_weak(left, left - bytes)) {
        return true;
      }
    }
    return false;
  }

  void giveBack(std::size_t bytes) { left_ += bytes; }

 private:
  const std::size_t total_;
  std::atomic<std::size_t> left_;
};

/// What one request holds of a budget; given back when it goes.
class ByteLease {
 public:
  explicit ByteLease(ByteBudget& budget) : budget_(&budget) {}
  ByteLease(const ByteLease&) = delete;
  ByteLease& operator=(const ByteLease&) = delete;
  ~ByteLease() { budget_->giveBack(held_); }

  bool grow(std::size_t bytes) {
    if (!budget_->take(bytes)) {
      return false;
    }
    held_ += bytes;
    return true;
  }

 private:
  ByteBudget* budget_;
  std::size_t held_ = 0;
};

} // namespace gnomon
