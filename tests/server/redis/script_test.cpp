#include <gtest/gtest.h>

#include "server/redis/reply.h"

namespace gnomon::redis {
namespace {

TEST(RedisScript, IsNamedByTheDigestOfItsText) {
  EXPECT_EQ(Script("abc").sha1(), "a9993e364706816aba3e25717850c26c9cd0d89d"); // FIPS 180-2, A.1
  EXPECT_EQ(Script("").sha1(), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
}

} // namespace
} // namespace gnomon::redis
