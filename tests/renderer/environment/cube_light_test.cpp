#include "renderer/environment/cube_light.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "renderer/core/light.h"
#include "renderer/environment/environment_file.h"
#include "renderer/environment/stated_irradiance.h"
#include "tests/renderer/made_cube.h"

namespace gnomon {
namespace {

using testing::Radiance;

std::shared_ptr<const CheckedImage> checked(const Bytes& png) {
  auto image = checkImage(png, 4096, 1 << 24);
  EXPECT_TRUE(image);
  return std::make_shared<const CheckedImage>(*std::move(image));
}

CubeLight cubeOf(int side, const Radiance& radiance) {
  CubeLight light;
  for (std::size_t face = 0; face < 6; ++face) {
    light.faces[face] = checked(testing::rgbdFace(face, side, radiance));
    light.places[face] = "/images/" + std::to_string(face);
  }
  return light;
}

EnvironmentMap mapOf(const CubeLight& light) {
  auto map = readCube(light);
  EXPECT_TRUE(map) << map.problems()[0].detail;
  return map ? *std::move(map) : EnvironmentMap{};
}

glm::dvec3 at(const EnvironmentMap& map, const glm::dvec3& towards) {
  const glm::dvec2 place = environmentPlace(towards) * glm::dvec2(map.width, map.height);
  return glm::dvec3(map.at(std::min(int(place.x), map.width - 1), std::min(int(place.y), map.height - 1)));
}

/// The greatest relative distance of a map to what it should show at its texels' centres.
double farthestFrom(const EnvironmentMap& map, const Radiance& right) {
  double farthest = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 want = right(environmentDirection({(x + 0.5) / map.width, (y + 0.5) / map.height}));
      farthest = std::max(farthest, glm::length(glm::dvec3(map.at(x, y)) - want) / glm::length(want));
    }
  }
  return farthest;
}

/// Smooth, another in each direction, and far above 1.
glm::dvec3 slopes(const glm::dvec3& d) {
  return 6.0 + 5.0 * glm::dvec3(d.x, d.y, d.z);
}

TEST(CubeLight, EachFaceLiesWhereTheHeaderSays) {
  const auto levelOf = [](std::size_t face) { return static_cast<std::uint8_t>(40 + 40 * face); };
  CubeLight light;
  for (std::size_t face = 0; face < 6; ++face) {
    light.faces[face] =
        checked(testing::pngOfTexels(32, 32, std::vector(1024, std::array<std::uint8_t, 4>{levelOf(face), 0, 0, 255})));
  }
  const EnvironmentMap map = mapOf(light);
  const glm::dvec3 towards[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (std::size_t face = 0; face < 6; ++face) {
    EXPECT_NEAR(at(map, towards[face]).x, linearOf(levelOf(face) / 255.0), 1e-5) << face;
  }
}

TEST(CubeLight, TheFirstRowIsTheLowestAndColumnsGoAsOpenGLHasThem) {
  // Red where the picture is at its left, green where it is at its top.
  std::vector<std::array<std::uint8_t, 4>> texels;
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      texels.push_back(
          {static_cast<std::uint8_t>(column < 16 ? 255 : 0), static_cast<std::uint8_t>(row < 16 ? 255 : 0), 0, 255});
    }
  }
  CubeLight light;
  light.faces.fill(checked(testing::pngOfTexels(32, 32, texels)));
  const EnvironmentMap map = mapOf(light);
  // Of each face: a direction towards its upper left quarter.
  const glm::dvec3 corners[] = {{1, -0.5, -0.5}, {-1, -0.5, 0.5},  {-0.5, 1, -0.5},
                                {-0.5, -1, 0.5}, {-0.5, -0.5, -1}, {0.5, -0.5, 1}};
  for (const glm::dvec3& corner : corners) {
    EXPECT_NEAR(glm::length(at(map, corner) - glm::dvec3(1, 1, 0)), 0, 1e-5) << corner.x << ' ' << corner.y;
  }
  // Of the sides, towards their lower halves in the picture: up in the world, and dark green.
  for (const glm::dvec3& side : {glm::dvec3(1, 0.5, 0), {-1, 0.5, 0}, {0, 0.5, 1}, {0, 0.5, -1}}) {
    EXPECT_NEAR(at(map, side).y, 0, 1e-5);
  }
}

TEST(CubeLight, ASmoothPictureIsResampledWithoutSeams) {
  EXPECT_LT(farthestFrom(mapOf(cubeOf(64, slopes)), slopes), 0.02); // of which bytes are about 0.01
}

TEST(CubeLight, ItIsTurnedAboutAnyAxisAndMultiplied) {
  CubeLight light = cubeOf(64, slopes);
  const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, 2, -0.5))));
  light.cubeFromWorld = glm::transpose(turn);
  light.intensity = 0.25;
  const auto turned = [&](const glm::dvec3& d) { return 0.25 * slopes(glm::transpose(turn) * d); };
  EXPECT_LT(farthestFrom(mapOf(light), turned), 0.02);
}

TEST(CubeLight, OneBrightTexelKeepsItsLightWhereverItLies) {
  constexpr int kSide = 64;
  for (const auto& [face, row, column] : {std::array{0, 32, 32}, {0, 0, 32}, {2, 5, 63}, {4, 63, 40}, {5, 0, 0}}) {
    const double s = (2.0 * column + 1) / kSide - 1, t = 1 - (2.0 * row + 1) / kSide;
    const glm::dvec3 towards = testing::towardsFace(std::size_t(face), s, t);
    const CubeLight light =
        cubeOf(kSide, [&](const glm::dvec3& d) { return glm::dvec3(glm::dot(d, towards) > 1 - 1e-9 ? 255 : 0); });
    const EnvironmentMap map = mapOf(light);
    double sum = 0;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) sum += double{map.at(x, y).x} * texelSolidAngle(map, y);
    }
    const double solidAngle = 4.0 / (kSide * kSide) / std::pow(1 + s * s + t * t, 1.5);
    const bool atCorner = face == 5;
    EXPECT_NEAR(sum / (255 * solidAngle), 1, atCorner ? 0.15 : 0.02) << face << ' ' << row << ' ' << column;
  }
}

TEST(CubeLight, TheSmallestFacesAreAMapToo) {
  const EnvironmentMap map = mapOf(cubeOf(1, [](const glm::dvec3&) { return glm::dvec3(2); }));
  EXPECT_EQ(map.width, 8);
  EXPECT_LT(farthestFrom(map, [](const glm::dvec3&) { return glm::dvec3(2); }), 0.01);
}

std::string detailOf(const CubeLight& light) {
  const auto map = readCube(light);
  return map ? "none" : map.problems().front().detail;
}

TEST(CubeLight, WhatIsNoLightIsNamedByItsPlace) {
  const CubeLight sound = cubeOf(4, slopes);
  CubeLight clear = sound;
  std::vector<std::array<std::uint8_t, 4>> texels(16, {9, 9, 9, 255});
  texels[6] = {9, 9, 9, 0};
  clear.faces[3] = checked(testing::pngOfTexels(4, 4, texels));
  EXPECT_NE(detailOf(clear).find("/images/3 has an alpha of 0"), std::string::npos) << detailOf(clear);
  EXPECT_NE(detailOf(clear).find("column 2, row 1"), std::string::npos) << detailOf(clear);

  CubeLight damaged = sound;
  CheckedImage broken = *sound.faces[1];
  for (std::size_t i = broken.picture.bytes.size() / 2; i < broken.picture.bytes.size(); ++i) {
    broken.picture.bytes[i] ^= 0x55;
  }
  damaged.faces[1] = std::make_shared<const CheckedImage>(broken);
  EXPECT_NE(detailOf(damaged).find("/images/1 is damaged"), std::string::npos) << detailOf(damaged);

  CubeLight bright = sound;
  bright.intensity = 1e300;
  EXPECT_NE(detailOf(bright).find("radiance that light can't have"), std::string::npos) << detailOf(bright);
}

/// The spherical harmonics that the file states, of all colors.
std::array<glm::dvec3, 9> statedOf(double mean, const glm::dvec3& slope) {
  std::array<glm::dvec3, 9> all{};
  const auto json = testing::coefficientsOf(mean, slope);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = glm::dvec3(json[i][0].get<double>());
  return all;
}

TEST(CubeLight, WhatAFileStatesAsIrradianceIsHeldAgainstItsPicture) {
  const glm::dvec3 slope(1, 2, 3);
  CubeLight light = cubeOf(32, [&](const glm::dvec3& d) { return glm::dvec3(5 + glm::dot(slope, d)); });
  light.cubeFromWorld = glm::transpose(glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 1, 2)))));
  light.intensity = 3;
  const auto differenceOf = [&](const std::array<glm::dvec3, 9>& stated) {
    light.irradiance = stated;
    return EnvironmentFile(light).read(SunExtraction::none)->facts.irradianceDifference;
  };
  EXPECT_LT(differenceOf(statedOf(5, slope)), 0.01);
  EXPECT_NEAR(differenceOf(statedOf(10, 2.0 * slope)), 1, 0.01);
  EXPECT_GT(differenceOf(statedOf(5, {1, 2, -3})), 0.3) << "mirrored";
}

TEST(CubeLight, MemoryIsThatOfItsMapAndFaces) {
  const CubeLight light = cubeOf(64, slopes);
  EXPECT_EQ(EnvironmentFile(light).memory(), bytesIn(light) + 256 * 128 * sizeof(glm::vec3));
}

} // namespace
} // namespace gnomon
