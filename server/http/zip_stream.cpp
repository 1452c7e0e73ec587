#include "server/http/zip_stream.h"

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon {
namespace {

constexpr std::uint16_t kZip64Version = 45;
constexpr std::uint16_t kFirstDay = (1 << 5) | 1; ///< 1 January 1980

void put(std::string& text, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i, value >>= 8) text += static_cast<char>(value & 0xff);
}

/// Eight tables, so that eight bytes are looked up at once.
using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr CrcTables makeTables() {
  CrcTables tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    tables[0][i] = crc;
  }
  for (std::size_t i = 0; i < 256; ++i) {
    for (std::size_t k = 1; k < 8; ++k) tables[k][i] = tables[k - 1][i] >> 8 ^ tables[0][tables[k - 1][i] & 0xff];
  }
  return tables;
}

constexpr CrcTables kTables = makeTables();

} // namespace

std::uint32_t crc32Of(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = ~0u;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t before = k < 4 ? crc >> (8 * k) : 0;
      const std::size_t byte = (bytes[i + k] ^ before) & 0xff;
      next ^= kTables[7 - k][byte];
    }
    crc = next;
  }
  for (; i < bytes.size(); ++i) crc = crc >> 8 ^ kTables[0][(crc ^ bytes[i]) & 0xff];
  return ~crc;
}

std::string ZipStream::head(std::string_view name, std::uint32_t size, std::uint32_t crc32) {
  const bool isFar = offset_ >= std::numeric_limits<std::uint32_t>::max();
  std::string shared; // by both heads of the file: flags, stored, time, date, check, sizes, length of the name
  put(shared, 0, 4);
  put(shared, 0, 2);
  put(shared, kFirstDay, 2);
  put(shared, crc32, 4);
  put(shared, size, 4);
  put(shared, size, 4);
  put(shared, name.size(), 2);

  std::string local;
  put(local, 0x04034b50, 4);
  put(local, 20, 2);
  local += shared;
  put(local, 0, 2);
  local += name;

  put(directory_, 0x02014b50, 4);
  put(directory_, kZip64Version, 2);
  put(directory_, isFar ? kZip64Version : 20, 2);
  directory_ += shared;
  put(directory_, isFar ? 12 : 0, 2);
  put(directory_, 0, 2 + 2 + 2 + 4); // comment, disk, attributes
  put(directory_, std::min<std::uint64_t>(offset_, 0xffffffff), 4);
  directory_ += name;
  if (isFar) {
    put(directory_, 1, 2);
    put(directory_, 8, 2);
    put(directory_, offset_, 8);
  }
  ++files_;
  offset_ += local.size() + size;
  return local;
}

std::string ZipStream::end() {
  std::string tail = directory_;
  const std::uint64_t size = directory_.size();
  const std::uint64_t after = offset_ + size;
  if (files_ >= 0xffff || after >= 0xffffffff) {
    put(tail, 0x06064b50, 4);
    put(tail, 44, 8);
    put(tail, kZip64Version, 2);
    put(tail, kZip64Version, 2);
    put(tail, 0, 4 + 4);
    put(tail, files_, 8);
    put(tail, files_, 8);
    put(tail, size, 8);
    put(tail, offset_, 8);
    put(tail, 0x07064b50, 4);
    put(tail, 0, 4);
    put(tail, after, 8);
    put(tail, 1, 4);
  }
  put(tail, 0x06054b50, 4);
  put(tail, 0, 2 + 2);
  put(tail, std::min<std::uint64_t>(files_, 0xffff), 2);
  put(tail, std::min<std::uint64_t>(files_, 0xffff), 2);
  put(tail, std::min<std::uint64_t>(size, 0xffffffff), 4);
  put(tail, std::min<std::uint64_t>(offset_, 0xffffffff), 4);
  put(tail, 0, 2);
  return tail;
}

} // namespace gnomon
