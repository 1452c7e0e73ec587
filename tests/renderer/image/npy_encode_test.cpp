#include "renderer/image/npy_encode.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <string>

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

} // namespace
} // namespace gnomon
