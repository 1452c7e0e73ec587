#include "renderer/prepare/named_tiles.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using Pixel = std::array<int, 3>;

Pixel at(const Image& picture, int x, int y) {
  const auto& bytes = std::get<std::vector<std::uint8_t>>(picture.pixels);
  const auto first = static_cast<std::size_t>(y * picture.width + x) * 3;
  return {bytes.at(first), bytes.at(first + 1), bytes.at(first + 2)};
}

/// Light 3 with two tiles: the first, not drawn, and one at the upper right of 128 x 128.
ShadowPlan plan() {
  ShadowPlan made;
  made.atlasWidth = made.atlasHeight = 128;
  made.tiles.resize(2);
  made.tiles[1].rect = {64, 64, 64, 64};
  PlannedLight light;
  light.light = 3;
  light.tileCount = 2;
  made.lights = {light};
  return made;
}

Image grey() {
  return {128, 128, {"Y"}, std::vector<std::uint8_t>(128u * 128, 77)};
}

TEST(NamedTiles, M15_ATileIsOutlinedInItsTintAndAllElseStaysGrey) {
  const Image picture = namedTiles(grey(), plan());
  ASSERT_EQ(picture.channels, (std::vector<std::string>{"R", "G", "B"}));
  const Pixel blue{160, 188, 255}; // of the second tile
  for (int i = 0; i < 64; ++i) {
    EXPECT_EQ(at(picture, 64 + i, 0), blue);
    EXPECT_EQ(at(picture, 64 + i, 63), blue);
    EXPECT_EQ(at(picture, 127, i), blue);
    EXPECT_EQ(at(picture, 64, i), blue);
  }
  EXPECT_EQ(at(picture, 100, 40), (Pixel{77, 77, 77})) << "within";
  EXPECT_EQ(at(picture, 63, 30), (Pixel{77, 77, 77})) << "beside";
  EXPECT_EQ(at(picture, 0, 127), (Pixel{77, 77, 77})) << "a tile that was not drawn has no outline";
}

TEST(NamedTiles, M15_ItsNameIsLightAndTile) {
  const Image picture = namedTiles(grey(), plan());
  std::string text;
  for (int y = 2; y < 9; ++y) {
    for (int x = 66; x < 79; ++x) text += at(picture, x, y) == Pixel{} ? '#' : ' ';
    text += '\n';
  }
  EXPECT_EQ(text,
            "####      #  \n"
            "    #    ##  \n"
            "    #     #  \n"
            " ###      #  \n"
            "    #     #  \n"
            "    #     #  \n"
            "####  #  ### \n");
}

} // namespace
} // namespace gnomon
