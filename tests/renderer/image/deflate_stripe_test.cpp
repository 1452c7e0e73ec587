#include "renderer/image/deflate_stripe.h"

#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>
#include <zlib.h>

namespace gnomon {
namespace {

/// What a raw deflate stream holds; empty where it is unsound or has bytes behind its end.
Bytes inflated(Bytes stream, std::size_t size) {
  z_stream zlib{};
  inflateInit2(&zlib, -MAX_WBITS);
  Bytes data(size + 1);
  zlib.next_in = stream.data();
  zlib.avail_in = static_cast<uInt>(stream.size());
  zlib.next_out = data.data();
  zlib.avail_out = static_cast<uInt>(data.size());
  const bool sound = inflate(&zlib, Z_FINISH) == Z_STREAM_END && zlib.avail_in == 0;
  data.resize(sound ? zlib.total_out : 0);
  inflateEnd(&zlib);
  return data;
}

/// Runs, repetitions and noise of `size` bytes.
Bytes mixture(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  Bytes data;
  while (data.size() < size) {
    const std::size_t length = 1 + random() % 5000;
    const auto kind = random() % 3;
    const auto value = static_cast<std::uint8_t>(random());
    for (std::size_t i = 0; i < length; ++i) {
      data.push_back(kind == 0 ? value : static_cast<std::uint8_t>(kind == 1 ? random() : random() % 7 * value));
    }
  }
  data.resize(size);
  return data;
}

TEST(DeflateStripe, PiecesInOrderAreAStreamAtEveryLevel) {
  for (int level = 0; level <= 9; ++level) {
    for (const unsigned seed : {1u, 2u, 3u}) {
      Bytes whole;
      Bytes stream;
      for (const std::size_t size : {1ul, 70000ul, 2ul, 300ul, 400000ul, 65535ul}) {
        const Bytes piece = mixture(size, seed * 7919u + static_cast<unsigned>(size));
        const Bytes deflated = deflateStripe(piece, level);
        whole.insert(whole.end(), piece.begin(), piece.end());
        stream.insert(stream.end(), deflated.begin(), deflated.end());
      }
      stream.insert(stream.end(), std::begin(kDeflateEnd), std::end(kDeflateEnd));
      EXPECT_TRUE(inflated(stream, whole.size()) == whole) << "level " << level << ", seed " << seed;
    }
  }
}

TEST(DeflateStripe, AnyBytesComeBack) {
  EXPECT_TRUE(rc::check("inflate(deflate(a) + deflate(b) + end) == a + b", [] {
    const auto bytes = rc::gen::nonEmpty(rc::gen::container<Bytes>(rc::gen::arbitrary<std::uint8_t>()));
    const Bytes first = *bytes;
    const Bytes second = *bytes;
    const int level = *rc::gen::inRange(0, 10);
    Bytes stream = deflateStripe(first, level);
    const Bytes more = deflateStripe(second, level);
    stream.insert(stream.end(), more.begin(), more.end());
    stream.insert(stream.end(), std::begin(kDeflateEnd), std::end(kDeflateEnd));
    Bytes both = first;
    both.insert(both.end(), second.begin(), second.end());
    RC_ASSERT(inflated(stream, both.size()) == both);
  }));
}

/// Leaves `value`, as numbers of 16 bits, in much of the memory that the next allocations get.
void soilFreeMemory(std::uint16_t value) {
  std::vector<std::vector<std::uint16_t>> blocks;
  for (std::size_t size = 500; size < 60000; size += 500) blocks.emplace_back(size, value);
  for (const auto& block : blocks) EXPECT_EQ(block.back(), value);
}

TEST(DeflateStripe, DoesNotDependOnWhatMemoryHeldBefore) {
  const Bytes data = mixture(100000, 3);
  for (int level = 0; level <= 9; ++level) {
    const Bytes first = deflateStripe(data, level);
    for (std::uint16_t value = 0; value <= 16; ++value) {
      soilFreeMemory(value);
      EXPECT_TRUE(deflateStripe(data, level) == first) << "level " << level << ", memory of " << value;
    }
  }
}

TEST(DeflateStripe, DoesNotDependOnWhereMemoryIs) {
  // Rows of mostly one value: the first places of the data decide what follows.
  std::vector<Bytes> datas;
  for (std::uint8_t value = 0; value < 8; ++value) {
    Bytes data(600, value);
    data[0] = 1;
    data[1] = 255;
    for (std::size_t i = 213; i < data.size(); i += 213) data[i] = 2;
    datas.push_back(std::move(data));
  }
  // More than deflate's window of 32 KiB, nearly all zero: the first places of the data are met again behind it.
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    std::mt19937 random(seed);
    Bytes data(49168);
    for (std::size_t row = 0; row < data.size(); row += 3073) {
      data[row] = 2;
      for (int i = 0; i < 6; ++i) data[row + 1 + random() % 280] = static_cast<std::uint8_t>(random());
    }
    datas.push_back(std::move(data));
  }
  std::vector<Bytes> first;
  for (const Bytes& data : datas) first.push_back(deflateStripe(data, 2));
  std::vector<std::unique_ptr<char[]>> between; // so that what comes after lies elsewhere
  int different = 0;
  for (int i = 0; i < 2500; ++i) {
    for (std::size_t d = 0; d < datas.size(); ++d) different += deflateStripe(datas[d], 2) == first[d] ? 0 : 1;
    between.push_back(std::make_unique_for_overwrite<char[]>(i % 2 == 0 ? 65536 : 100000));
  }
  EXPECT_EQ(different, 0);
}

TEST(DeflateStripe, NoiseGrowsByTheHeadersOfStoredBlocksOnly) {
  Bytes noise(200000);
  std::mt19937 random(5);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
  for (int level = 0; level <= 9; ++level) EXPECT_LE(deflateStripe(noise, level).size(), noise.size() + 4 * 5) << level;
}

TEST(DeflateStripe, HigherLevelsAreSmaller) {
  std::mt19937 random(11);
  Bytes slope;
  for (int i = 0; i < 300000; ++i) slope.push_back(static_cast<std::uint8_t>((random() & random() & random()) % 5));
  std::size_t before = slope.size() + 100;
  for (int level = 0; level <= 9; ++level) {
    const std::size_t size = deflateStripe(slope, level).size();
    EXPECT_LT(size, before) << "level " << level;
    before = size;
  }
}

} // namespace
} // namespace gnomon
