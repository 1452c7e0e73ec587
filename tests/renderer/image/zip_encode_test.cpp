#include "renderer/image/zip_encode.h"

#include <gtest/gtest.h>
#include <map>
#include <rapidcheck.h>
#include <tbb/global_control.h>
#include <zlib.h>

namespace gnomon {
namespace {

std::uint32_t number(const Bytes& file, std::size_t at, std::size_t bytes) {
  return static_cast<std::uint32_t>(littleEndian(std::span(file).subspan(at, bytes)));
}

Bytes inflated(std::span<const std::uint8_t> packed, std::size_t size) {
  Bytes content(size + 1); // room to see that there is no more
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
  stream.next_in = const_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = content.data();
  stream.avail_out = static_cast<uInt>(content.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  content.resize(stream.total_out);
  inflateEnd(&stream);
  return content;
}

/// Every file of a ZIP, by its directory; both headers are expected to say the same.
std::map<std::string, Bytes> read(const Bytes& zip) {
  std::map<std::string, Bytes> files;
  const std::size_t end = zip.size() - 22;
  EXPECT_EQ(number(zip, end, 4), 0x06054b50u);
  std::size_t at = number(zip, end + 16, 4);
  EXPECT_EQ(at + number(zip, end + 12, 4), end);
  for (std::uint32_t i = 0; i < number(zip, end + 10, 2); ++i) {
    EXPECT_EQ(number(zip, at, 4), 0x02014b50u);
    const std::size_t nameLength = number(zip, at + 28, 2);
    const std::string name(zip.begin() + static_cast<std::ptrdiff_t>(at + 46),
                           zip.begin() + static_cast<std::ptrdiff_t>(at + 46 + nameLength));
    const std::size_t local = number(zip, at + 42, 4);
    EXPECT_EQ(number(zip, local, 4), 0x04034b50u);
    for (std::size_t fact = 0; fact < 24; fact += 2) {
      EXPECT_EQ(number(zip, local + 4 + fact, 2), number(zip, at + 6 + fact, 2)) << name << ' ' << fact;
    }
    const auto packed = std::span(zip).subspan(local + 30 + nameLength, number(zip, at + 20, 4));
    const std::size_t size = number(zip, at + 24, 4);
    Bytes content = number(zip, at + 10, 2) == 8 ? inflated(packed, size) : Bytes(packed.begin(), packed.end());
    EXPECT_EQ(content.size(), size) << name;
    EXPECT_EQ(number(zip, at + 16, 4), crc32(0, content.data(), static_cast<uInt>(content.size()))) << name;
    files[name] = std::move(content);
    at += 46 + nameLength;
  }
  EXPECT_EQ(at, end);
  return files;
}

Bytes written(const std::map<std::string, Bytes>& files) {
  ZipWriter zip;
  for (const auto& [name, content] : files) EXPECT_TRUE(zip.add(name, content));
  auto file = std::move(zip).finish();
  EXPECT_TRUE(file);
  return file ? *std::move(file) : Bytes{};
}

TEST(ZipWriter, GivesBackEveryFile) {
  EXPECT_TRUE(rc::check("read(write(files)) == files", [] {
    const auto contents = *rc::gen::arbitrary<std::vector<Bytes>>();
    std::map<std::string, Bytes> files;
    for (const Bytes& content : contents) files["view" + std::to_string(files.size()) + ".npy"] = content;
    RC_ASSERT(read(written(files)) == files);
  }));
}

/// Several stripes of slopes, and noise.
std::map<std::string, Bytes> large() {
  Bytes slopes(700'001), noise(300'000);
  std::uint32_t random = 1;
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = static_cast<std::uint8_t>(i / 900);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>((random = random * 1664525u + 1013904223u) >> 24);
  return {{"slopes", slopes}, {"noise", noise}};
}

TEST(ZipWriter, DeflatesWhatGetsSmallerAndStoresTheRest) {
  const Bytes zip = written(large());
  EXPECT_EQ(read(zip), large());
  EXPECT_LT(zip.size(), 330'000u);
  EXPECT_EQ(number(zip, 8, 2), 0u) << "noise is stored";
}

TEST(ZipWriter, AnyNumberOfThreadsGivesTheSameBytes) {
  Bytes alone;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    alone = written(large());
  }
  EXPECT_EQ(alone, written(large()));
}

} // namespace
} // namespace gnomon
