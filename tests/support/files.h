#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "renderer/image/image.h"

namespace gnomon::testing {

/// The whole file; empty when there is none.
inline Bytes readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

inline void writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

} // namespace gnomon::testing
