#include "protocol/base/sha256.h"

#include <gtest/gtest.h>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

TEST(Sha256, KnownVectors) { // FIPS 180-2, appendix B
  EXPECT_EQ(Sha256().hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  Sha256 hash;
  hash.add("abc");
  EXPECT_EQ(hash.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, PiecesAreTheWhole) {
  Sha256 hash;
  hash.add("a");
  hash.add("");
  hash.add(asBytes("bc"));
  EXPECT_EQ(hash.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

} // namespace
} // namespace gnomon
