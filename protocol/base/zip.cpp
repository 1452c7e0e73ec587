#include "protocol/base/zip.h"

#include <algorithm>
#include <libdeflate.h>
#include <limits>

namespace gnomon {
namespace {

constexpr std::uint16_t kVersion = 20;            ///< 2.0: deflate
constexpr std::uint16_t kZip64Version = 45;       ///< 4.5
constexpr std::uint16_t kFirstDay = (1 << 5) | 1; ///< 1 January 1980
constexpr std::uint64_t kMost16 = 0xffff;         ///< means: see ZIP64
constexpr std::uint64_t kMost32 = 0xffffffff;     ///< the same

void put(std::string& text, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i, value >>= 8) text += static_cast<char>(value & 0xff);
}

/// What both heads have, from the flags to the length of the name.
void putFacts(std::string& text, const ZipFile& file) {
  put(text, 0, 2);
  put(text, file.isDeflated ? 8 : 0, 2);
  put(text, 0, 2); // midnight
  put(text, kFirstDay, 2);
  put(text, file.crc32, 4);
  put(text, file.packedBytes, 4);
  put(text, file.bytes, 4);
  put(text, file.name.size(), 2);
}

} // namespace

std::string zipHead(const ZipFile& file) {
  std::string head;
  put(head, 0x04034b50, 4);
  put(head, kVersion, 2);
  putFacts(head, file);
  put(head, 0, 2);
  return head.append(file.name);
}

std::string zipDirectoryEntry(const ZipFile& file, std::uint64_t offset) {
  const bool isFar = offset >= kMost32;
  const std::uint16_t version = isFar ? kZip64Version : kVersion;
  std::string entry;
  put(entry, 0x02014b50, 4);
  put(entry, version, 2); // made by
  put(entry, version, 2); // needed
  putFacts(entry, file);
  put(entry, isFar ? 12 : 0, 2);
  put(entry, 0, 2 + 2 + 2);
  put(entry, 0, 4); // attributes
  put(entry, std::min(offset, kMost32), 4);
  entry += file.name;
  if (isFar) {
    put(entry, 1, 2);
    put(entry, 8, 2);
    put(entry, offset, 8);
  }
  return entry;
}

std::string zipEnd(std::uint64_t files, std::uint64_t directoryBytes, std::uint64_t offset) {
  std::string end;
  if (const std::uint64_t after = offset + directoryBytes; files >= kMost16 || after >= kMost32) {
    put(end, 0x06064b50, 4);
    put(end, 44, 8);
    put(end, kZip64Version, 2);
    put(end, kZip64Version, 2);
    put(end, 0, 4 + 4);
    put(end, files, 8);
    put(end, files, 8);
    put(end, directoryBytes, 8);
    put(end, offset, 8);
    put(end, 0x07064b50, 4);
    put(end, 0, 4);
    put(end, after, 8);
    put(end, 1, 4);
  }
  put(end, 0x06054b50, 4);
  put(end, 0, 2 + 2);
  put(end, std::min(files, kMost16), 2);
  put(end, std::min(files, kMost16), 2);
  put(end, std::min(directoryBytes, kMost32), 4);
  put(end, std::min(offset, kMost32), 4);
  put(end, 0, 2);
  return end;
}

std::uint32_t crc32Of(std::span<const std::uint8_t> bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

} // namespace gnomon
