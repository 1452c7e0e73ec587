#include "server/http/request_id.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <string_view>

#include "server/http/ascii.h"

namespace gnomon {
namespace {

bool isWellFormed(std::string_view id) {
  constexpr std::string_view kMarks = "-._:";
  return !id.empty() && id.size() <= 128 && std::all_of(id.begin(), id.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kMarks.find(c) != std::string_view::npos;
  });
}

/// Unique in this process and, by its random start, very likely between processes.
std::string newId() {
  static const std::uint64_t start = (std::uint64_t{std::random_device{}()} << 32) | std::random_device{}();
  static std::atomic<std::uint64_t> count{0};
  const std::uint64_t value = start + ++count;
  std::array<char, 8> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(value >> (56 - 8 * i));
  }
  return hexText({bytes.data(), bytes.size()});
}

} // namespace

std::string requestId(const std::optional<std::string>& offered) {
  return offered && isWellFormed(*offered) ? *offered : newId();
}

} // namespace gnomon
