#include "protocol/base/zip.h"

#include <gtest/gtest.h>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

std::uint64_t zipNumber(std::string_view text, std::size_t at, std::size_t bytes) {
  return littleEndian(asBytes(text.substr(at, bytes)));
}

TEST(Zip, TheCheckIsTheOneThatZipNames) {
  EXPECT_EQ(crc32Of(asBytes("123456789")), 0xcbf43926u); // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32Of({}), 0u);
  EXPECT_EQ(crc32Of(asBytes("The quick brown fox jumps over the lazy dog")), 0x414fa339u);
}

TEST(Zip, BothHeadsTellTheSameOfAFile) {
  const ZipFile file{.name = "a.npy", .crc32 = 0x12345678, .bytes = 900, .packedBytes = 17, .isDeflated = true};
  const std::string head = zipHead(file);
  const std::string entry = zipDirectoryEntry(file, 4711);
  ASSERT_EQ(head.size(), 30u + 5);
  ASSERT_EQ(entry.size(), 46u + 5);
  EXPECT_EQ(head.substr(6, 22), entry.substr(8, 22)) << "flags to the length of the name";
  EXPECT_EQ(zipNumber(head, 8, 2), 8u) << "deflated";
  EXPECT_EQ(zipNumber(head, 14, 4), 0x12345678u);
  EXPECT_EQ(zipNumber(head, 18, 4), 17u);
  EXPECT_EQ(zipNumber(head, 22, 4), 900u);
  EXPECT_EQ(zipNumber(entry, 42, 4), 4711u);
}

} // namespace
} // namespace gnomon
