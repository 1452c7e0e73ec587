#include "renderer/frame/environment_cache.h"

#include <gtest/gtest.h>

#include "renderer/environment/make_environment.h"
#include "tests/renderer/made_environment.h"

namespace gnomon {
namespace {

Sky skyAt(double azimuthDegrees) {
  Sky sky;
  sky.sun = Sun{.azimuthDegrees = azimuthDegrees, .elevationDegrees = 30};
  return sky;
}

std::shared_ptr<const EnvironmentFile> evenFile() {
  return std::make_shared<const EnvironmentFile>(testing::hdrFile(16, [](const glm::dvec3&) { return glm::dvec3(1); }));
}

TEST(EnvironmentCache, SharesWhatIsMadeOfTheSame) {
  EnvironmentCache cache;
  const auto file = evenFile(), other = evenFile();
  const auto first = cache.get(file, SunExtraction::auto_);
  ASSERT_TRUE(first);
  EXPECT_EQ(*cache.get(file, SunExtraction::removed), *first) << "without its sun, too";
  EXPECT_NE(*cache.get(file, SunExtraction::none), *first);
  EXPECT_NE(*cache.get(other, SunExtraction::auto_), *first);
  EXPECT_EQ(cache.get(skyAt(10)), cache.get(skyAt(10)));
  EXPECT_NE(cache.get(skyAt(10)), cache.get(skyAt(11)));
  EXPECT_EQ(*cache.get(file, SunExtraction::auto_), *first);
}

TEST(EnvironmentCache, KeepsSkiesAndFilesTogetherWithinItsBudget) {
  const auto file = evenFile();
  const std::size_t ofSky = bytesIn(*EnvironmentCache().get(skyAt(0)));
  EXPECT_GT(ofSky, 20u << 20) << "prepared for every roughness";
  EnvironmentCache cache(2 * ofSky + ofSky / 2);
  const std::weak_ptr<const Environment> ofFile = *cache.get(file, SunExtraction::auto_);
  const std::weak_ptr<const Environment> first = cache.get(skyAt(1));
  EXPECT_FALSE(ofFile.expired());
  const std::weak_ptr<const Environment> second = cache.get(skyAt(2));
  EXPECT_TRUE(ofFile.expired()) << "the least recently used";
  EXPECT_FALSE(first.expired() || second.expired());
  EnvironmentCache small(1);
  const std::weak_ptr<const Environment> newest = small.get(skyAt(1));
  EXPECT_FALSE(newest.expired()) << "whatever its size";
}

TEST(EnvironmentCache, DropsThoseOfFilesThatAreInUseNowhereElse) {
  EnvironmentCache cache;
  auto file = evenFile();
  const std::weak_ptr<const Environment> ofFile = *cache.get(file, SunExtraction::auto_);
  file.reset();
  const auto next = evenFile();
  ASSERT_TRUE(cache.get(next, SunExtraction::auto_));
  EXPECT_TRUE(ofFile.expired());
}

} // namespace
} // namespace gnomon
