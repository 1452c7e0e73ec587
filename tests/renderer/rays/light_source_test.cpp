#include "renderer/rays/light_source.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck.h>
#include <set>
#include <vector>

namespace gnomon {
namespace {

/// A sample's place on the unit disc.
glm::dvec2 placeOf(std::uint32_t index, std::uint32_t count, std::uint64_t seed) {
  SampleWays ways;
  waysTo({.across = {1, 0, 0}, .up = {0, 1, 0}}, {index, index + 1, count}, seed, {0, 0, 1}, ways);
  return ways.length[0] * glm::dvec2(ways.direction[0][0], ways.direction[1][0]);
}

/// Shirley and Chiu's map with the library's sines.
glm::dvec2 mapped(glm::dvec2 square) {
  const glm::dvec2 p = 2.0 * square - 1.0;
  if (p == glm::dvec2(0)) return p;
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const double angle = wide ? std::atan(1) * p.y / p.x : 2 * std::atan(1) - std::atan(1) * p.x / p.y;
  return (wide ? p.x : p.y) * glm::dvec2(std::cos(angle), std::sin(angle));
}

TEST(LightSamples, LieWhereTheMapOfTheUnitSquarePutsThem) {
  EXPECT_TRUE(rc::check([] {
    const auto count = *rc::gen::inRange<std::uint32_t>(1, 1000);
    const auto index = *rc::gen::inRange<std::uint32_t>(0, count);
    // Index 0 lies at the square's lowest row but for the seed's lower half, at its left side but for the upper half.
    const auto seed = *rc::gen::oneOf(
        rc::gen::arbitrary<std::uint64_t>(),
        rc::gen::element<std::uint64_t>(0, ~0ull, 0x8000000080000000ull, 0x800000007fffffffull, 0x80000000ull));
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= ((index >> bit) & 1u) << (31 - bit);
    const glm::dvec2 square((index + double(seed >> 32) / 4294967296.0) / count,
                            (double(reversed ^ std::uint32_t(seed)) + 0.5) / 4294967296.0);
    RC_ASSERT(glm::length(placeOf(index, count, seed) - mapped(square)) < 2e-15);
  }));
}

TEST(LightSamples, WaysLeadToTheSamplesOfTheDisc) {
  EXPECT_TRUE(rc::check([] {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const auto count = *rc::gen::inRange<std::uint32_t>(1, 50);
    const auto first = *rc::gen::inRange<std::uint32_t>(0, count);
    const double far = *rc::gen::element(1.0, 1e-6, 1e9);
    LightSource light;
    light.type = *rc::gen::element(LightType::directional, LightType::point);
    light.axis = glm::normalize(glm::dvec3(1, -2, 0.5));
    light.position = glm::dvec3(3, 4, -5) * far;
    light.radius = *rc::gen::element(0.01, 1.0);
    const LightDisc disc = discFacing(light, {far, 0, 2 * far});
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 1, -0.2));
    SampleWays ways;
    waysTo(disc, {first, count, count}, seed, normal, ways);
    for (std::uint32_t k = 0; k < std::min(kLanes, count - first); ++k) {
      const glm::dvec2 place = placeOf(first + k, count, seed);
      const WayToLight way = wayAlong(disc.middle + disc.across * place.x + disc.up * place.y);
      const glm::dvec3 direction(ways.direction[0][k], ways.direction[1][k], ways.direction[2][k]);
      RC_ASSERT(glm::length(direction - way.direction) < 1e-14);
      RC_ASSERT(std::abs((disc.atInfinity ? 1 / ways.length[k] : ways.length[k] / way.length - 1)) < 1e-14);
      RC_ASSERT(ways.cosine[k] == glm::dot(direction, normal));
    }
  }));
}

/// How many of the places lie in the fullest of 2^across by 2^up equal rectangles of the unit square.
std::size_t fullest(const std::vector<SquarePlace>& places, int across, int up) {
  std::map<std::uint64_t, std::size_t> counts;
  for (const SquarePlace& place : places) {
    const std::uint64_t column = std::uint64_t{place.x} >> (32 - across);
    const std::uint64_t row = std::uint64_t{place.y} >> (32 - up);
    ++counts[column << 32 | row];
  }
  std::size_t most = 0;
  for (const auto& [rectangle, count] : counts) most = std::max(most, count);
  return most;
}

SquarePlace shifted(const SquarePlace& place, const SquarePlace& by) {
  return {place.x ^ by.x, place.y ^ by.y};
}

TEST(LightSamples, TheFirstOfASequenceFillEveryRectangleWhateverTheirNumber) {
  EXPECT_TRUE(rc::check([] {
    const int bits = *rc::gen::inRange(0, 11);
    const auto block = *rc::gen::inRange<std::uint32_t>(0, 5);
    const SquarePlace shift{*rc::gen::arbitrary<std::uint32_t>(), *rc::gen::arbitrary<std::uint32_t>()};
    std::vector<SquarePlace> places;
    for (std::uint32_t i = 0; i < (1u << bits); ++i)
      places.push_back(shifted(sequencePlace((block << bits) + i), shift));
    for (int across = 0; across <= bits; ++across) RC_ASSERT(fullest(places, across, bits - across) == 1u);
  }));
}

/// Where a pixel's ray of those from `first` up to `last` goes.
SquarePlace placeOf(const Interleaved& all, std::uint32_t x, std::uint32_t y, std::uint32_t ray, std::uint32_t first,
                    std::uint32_t last) {
  return shifted(all.place(ray), all.shift(x, y, Interleaved::isAligned(ray, first, last)));
}

/// Those that the pixels of a square of 4 x 4 with this corner send their first rays to.
std::vector<SquarePlace> placesOfSquare(std::uint32_t x, std::uint32_t y, std::uint32_t most, std::uint32_t rays) {
  const Interleaved all(most);
  std::vector<SquarePlace> places;
  for (std::uint32_t i = 0; i < 16; ++i) {
    for (std::uint32_t ray = 0; ray < rays; ++ray) {
      places.push_back(placeOf(all, x + i % 4, y + i / 4, ray, 0, rays));
    }
  }
  return places;
}

TEST(LightSamples, TheFirstRaysOfEverySquareOfPixelsFillEveryRectangle) {
  for (std::uint32_t corner = 0; corner < 7; ++corner) {
    for (const std::uint32_t most : {16u, 24u, 64u, 1024u}) {
      const auto places = placesOfSquare(corner, 2 * corner + 8, most, 1);
      for (int across = 0; across <= 4; ++across) EXPECT_EQ(fullest(places, across, 4 - across), 1u) << most;
    }
  }
}

TEST(LightSamples, AllRaysOfEverySquareOfPixelsFillEveryRectangle) {
  for (std::uint32_t corner = 0; corner < 7; ++corner) {
    for (int bits = 0; bits <= 6; ++bits) {
      const auto places = placesOfSquare(3 * corner, corner, 1u << bits, 1u << bits);
      for (int across = 0; across <= bits + 4; ++across) {
        EXPECT_EQ(fullest(places, across, bits + 4 - across), 1u) << bits;
      }
    }
  }
}

TEST(LightSamples, SomeRaysOfASquareOfPixelsCrowdNowhere) {
  for (const std::uint32_t rays : {3u, 4u, 8u, 12u}) {
    const auto places = placesOfSquare(1, 2, 12, rays);
    for (int across = 0; across <= 5; ++across) EXPECT_LE(fullest(places, across, 5 - across), rays) << rays;
  }
}

TEST(LightSamples, APixelsOwnRaysFillEveryRectangle) {
  for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
    for (int bits = 0; bits <= 4; ++bits) {
      const Interleaved all(12);
      std::vector<SquarePlace> places;
      const std::uint32_t rays = std::min(12u, 1u << bits);
      for (std::uint32_t ray = 0; ray < rays; ++ray) {
        places.push_back(placeOf(all, pixel % 4, pixel / 4, ray, 0, rays));
      }
      for (int across = 0; across <= bits; ++across) EXPECT_EQ(fullest(places, across, bits - across), 1u);
    }
  }
}

TEST(LightSamples, LaterRaysOfAllPixelsGoToOneQuarter) {
  const Interleaved all(64);
  for (std::uint32_t ray = 4; ray < 64; ++ray) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> quarters;
    for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
      const SquarePlace place = placeOf(all, pixel % 4, pixel / 4, ray, 4, 64);
      quarters.emplace(place.x >> 31, place.y >> 31);
    }
    EXPECT_EQ(quarters.size(), 1u) << ray;
  }
}

TEST(LightSamples, TheRaysOfASquareOfPixelsShareOutTheQuartersWhicheverAreSent) {
  const Interleaved all(32);
  for (std::uint32_t first = 0; first < 24; ++first) {
    for (std::uint32_t last = first + 1; last <= std::min(first + 24, 32u); ++last) {
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> quarters;
      for (std::uint32_t ray = first; ray < last; ++ray) {
        for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
          const SquarePlace place = placeOf(all, pixel % 4, pixel / 4, ray, first, last);
          ++quarters[{place.x >> 31, place.y >> 31}];
        }
      }
      for (const auto& [quarter, rays] : quarters) EXPECT_EQ(rays, 4 * (last - first)) << first << " to " << last;
    }
  }
}

/// The share of the unit disc that lies on the near side of a straight edge at this distance from the middle.
double shareBefore(double edge) {
  return (std::acos(-edge) + edge * std::sqrt(1 - edge * edge)) / (4 * std::atan(1));
}

TEST(LightSamples, APixelsOwnRaysFindTheShareThatAStraightEdgeLeaves) {
  const Interleaved all(16);
  double squares = 0;
  int edges = 0;
  for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
    std::vector<glm::dvec2> places;
    for (std::uint32_t ray = 0; ray < 16; ++ray) {
      const SquarePlace place = placeOf(all, pixel % 4, pixel / 4, ray, 0, 16);
      places.push_back(mapped({place.x * 0x1p-32, place.y * 0x1p-32}));
    }
    for (double turn = 0; turn < 6.28; turn += 0.07) {
      const glm::dvec2 across(std::cos(turn), std::sin(turn));
      for (double edge = -0.99; edge < 1; edge += 0.01) {
        const auto before = std::ranges::count_if(places, [&](const auto& at) { return glm::dot(at, across) < edge; });
        const double off = static_cast<double>(before) / 16 - shareBefore(edge);
        squares += off * off;
        ++edges;
      }
    }
  }
  EXPECT_LT(std::sqrt(squares / edges), 0.04) << "plain, Sobol's places are off by 0.046; at random, by 0.1";
}

TEST(LightSamples, SeedsDifferFromPointToPointAndStayForOne) {
  std::set<std::uint64_t> seeds;
  SurfacePoint point;
  for (std::uint32_t instance = 0; instance < 4; ++instance) {
    for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
      for (const double x : {0.0, 1e-300, 1.0, 1.0 + 0x1p-52, -1.0}) {
        point.instance = instance;
        point.triangle = triangle;
        point.position = {x, 2, 3};
        seeds.insert(seedOf(point));
        EXPECT_EQ(seedOf(point), seedOf(SurfacePoint(point)));
      }
    }
  }
  EXPECT_EQ(seeds.size(), 4u * 4 * 5);
}

} // namespace
} // namespace gnomon
