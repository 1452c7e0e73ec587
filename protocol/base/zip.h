#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// The parts of a ZIP beside the bytes of its files (APPNOTE.TXT 6.3.10, sections 4.3 and 4.5.3). Every file has the
/// first date that there is, so that equal files give equal bytes.
namespace gnomon {

/// An entry, as in its two headers. One that is not deflated is stored as it is.
struct ZipFile {
  std::string_view name; ///< ASCII
  std::uint32_t crc32 = 0;
  std::uint32_t bytes = 0;
  std::uint32_t packedBytes = 0; ///< `bytes` where it is stored
  bool isDeflated = false;
};

/// The header before the file's bytes.
std::string zipHead(const ZipFile& file);

/// The file in the directory. `offset`: of its head; from 4 GiB on as ZIP64.
std::string zipDirectoryEntry(const ZipFile& file, std::uint64_t offset);

/// The records after the directory, which lies at `offset`; as ZIP64 where the ZIP needs it.
std::string zipEnd(std::uint64_t files, std::uint64_t directoryBytes, std::uint64_t offset);

/// CRC-32 as ZIP has it.
std::uint32_t crc32Of(std::span<const std::uint8_t> bytes);

} // namespace gnomon
