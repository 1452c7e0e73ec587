#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck.h>
#include <string>
#include <tbb/global_control.h>
#include <zlib.h>

#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

/// An array as the format's page describes it, read without the writer's help.
struct Array {
  std::string descr;
  std::string shape;
  Bytes data;
};

std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t first = text.find(before) + before.size();
  return text.substr(first, text.find(after, first) - first);
}

Array read(const Bytes& file) {
  EXPECT_EQ(std::string(file.begin(), file.begin() + 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length = file[8] + 256u * file[9];
  EXPECT_EQ((10 + length) % 64, 0u);
  const std::string header(file.begin() + 10, file.begin() + 10 + static_cast<std::ptrdiff_t>(length));
  EXPECT_EQ(header.back(), '\n');
  EXPECT_NE(header.find("'fortran_order': False"), std::string::npos);
  return {between(header, "'descr': '", "'"), between(header, "'shape': (", ")"),
          Bytes(file.begin() + 10 + static_cast<std::ptrdiff_t>(length), file.end())};
}

template <class Number>
std::vector<Number> numbersOf(const Array& array) {
  std::vector<Number> numbers(array.data.size() / sizeof(Number));
  std::memcpy(numbers.data(), array.data.data(), array.data.size());
  return numbers;
}

TEST(EncodeNpy, HasRowsColumnsAndChannels) {
  const auto color = encodeNpy({2, 3, {"R", "G", "B"}, Bytes(18, 7)}, ArrayNumbers::float32);
  ASSERT_TRUE(color);
  EXPECT_EQ(read(*color).descr, "|u1");
  EXPECT_EQ(read(*color).shape, "3, 2, 3");
  EXPECT_EQ(read(*color).data, Bytes(18, 7));
  const auto depth = encodeNpy({1, 1, {"Z"}, std::vector<float>{INFINITY}}, ArrayNumbers::float32);
  ASSERT_TRUE(depth);
  EXPECT_EQ(read(*depth).descr, "<f4");
  EXPECT_EQ(read(*depth).shape, "1, 1");
  EXPECT_EQ(numbersOf<float>(read(*depth)), std::vector<float>{INFINITY});
}

TEST(EncodeNpy, WholeNumbersAreExact) {
  const std::vector<float> ids{-1, 0, 65536, 99999, 1000000};
  const auto file = encodeNpy({5, 1, {"id"}, ids}, ArrayNumbers::int32);
  ASSERT_TRUE(file);
  EXPECT_EQ(read(*file).descr, "<i4");
  EXPECT_EQ(numbersOf<std::int32_t>(read(*file)), (std::vector<std::int32_t>{-1, 0, 65536, 99999, 1000000}));
}

TEST(EncodeNpy, AssociatesAlphaAsAnExrDoes) {
  const auto file = encodeNpy({1, 1, {"R", "G", "B", "A"}, std::vector<float>{8, 4, 2, 0.25f}}, ArrayNumbers::float32);
  ASSERT_TRUE(file);
  EXPECT_EQ(numbersOf<float>(read(*file)), (std::vector<float>{2, 1, 0.5f, 0.25f}));
  const auto bytes = encodeNpy({1, 1, {"R", "G", "B", "A"}, Bytes{8, 4, 2, 64}}, ArrayNumbers::float32);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(read(*bytes).data, (Bytes{8, 4, 2, 64})) << "bytes are straight, as in a PNG";
}

TEST(EncodeNpy, HoldsWhateverItIsGiven) {
  EXPECT_TRUE(rc::check("read(encode(image)) == image", [] {
    const int width = *rc::gen::inRange(1, 30), height = *rc::gen::inRange(1, 30);
    const int channels = *rc::gen::inRange(1, 5);
    const std::vector<std::string> names{"P", "Q", "S", "T"};
    const auto count = static_cast<std::size_t>(width * height * channels);
    const auto floats = *rc::gen::container<std::vector<float>>(count, rc::gen::arbitrary<float>());
    const Image image{width, height, {names.begin(), names.begin() + channels}, floats};
    const auto file = encodeNpy(image, ArrayNumbers::float32);
    RC_ASSERT(bool(file));
    const Array array = read(*file);
    const std::string size = std::to_string(height) + ", " + std::to_string(width);
    RC_ASSERT(array.shape == (channels == 1 ? size : size + ", " + std::to_string(channels)));
    RC_ASSERT(numbersOf<float>(array) == floats);
  }));
}

TEST(EncodeNpy, RefusesWhatIsNoArray) {
  EXPECT_FALSE(encodeNpy({2, 1, {"Y"}, Bytes{1}}, ArrayNumbers::float32));
  EXPECT_FALSE(encodeNpy({0, 0, {"Y"}, Bytes{}}, ArrayNumbers::float32));
  EXPECT_FALSE(encodeNpy({1, 1, {"Y"}, std::vector<std::uint16_t>{1}}, ArrayNumbers::float32));
}

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
std::map<std::string, Bytes> filesOf(const Bytes& zip) {
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
  EXPECT_TRUE(rc::check("files of a ZIP of files are those", [] {
    const auto contents = *rc::gen::arbitrary<std::vector<Bytes>>();
    std::map<std::string, Bytes> files;
    for (const Bytes& content : contents) files["view" + std::to_string(files.size()) + ".npy"] = content;
    RC_ASSERT(filesOf(written(files)) == files);
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
  EXPECT_EQ(filesOf(zip), large());
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
