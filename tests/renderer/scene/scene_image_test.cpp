#include "renderer/scene/scene_image.h"

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/image/picture_encode.h"
#include "renderer/scene/texture_reads.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Bytes pngOf(int side, std::uint8_t value) {
  Image image{side, side, {"R", "G", "B"}, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * side * side), value)};
  auto encoded = encodePng(image, 0);
  EXPECT_TRUE(encoded);
  return *std::move(encoded);
}

/// Its structure holds, its pixels don't.
Bytes brokenPng(int side) {
  Bytes png = pngOf(side, 9);
  png[png.size() - 20] ^= 0xff; // in the pixels, or their checksum
  return png;
}

std::shared_ptr<const SceneImage> imageOf(const Bytes& png, const std::string& pointer) {
  auto checked = checkImage(png, 64, 4096);
  EXPECT_TRUE(checked);
  return std::make_shared<const SceneImage>(*std::move(checked), pointer);
}

TEST(SceneImage, KnowsItsSizeAndDecodesOnceForAllThreads) {
  const auto image = imageOf(pngOf(20, 7), "/images/0");
  EXPECT_EQ(image->width(), 20);
  EXPECT_EQ(image->height(), 20);
  EXPECT_EQ(image->bytes(), 20u * 20u * 4u);
  std::vector<const Image*> seen(8);
  {
    std::vector<std::jthread> threads;
    for (const Image*& each : seen) threads.emplace_back([&each, &image] { each = &image->pixels(); });
  }
  EXPECT_THAT(seen, ::testing::Each(&image->pixels()));
  EXPECT_EQ(std::get<0>(image->pixels().pixels)[0], 7);
}

TEST(SceneImage, ForAReaderWhoNeedsThemOnceItsPixelsAreNotKept) {
  const auto image = imageOf(pngOf(20, 7), "/images/0");
  std::vector<std::pair<int, std::size_t>> taken; // the first row and the bytes of each call
  const std::uint8_t* last = nullptr;
  const auto take = [&](int first, std::span<const std::uint8_t> rgba) {
    EXPECT_EQ(rgba[0], 7);
    taken.emplace_back(first, rgba.size());
    last = rgba.data();
  };
  ASSERT_TRUE(image->readRows(16, take));
  EXPECT_THAT(taken, ElementsAre(std::pair(0, 16u * 80u), std::pair(16, 4u * 80u)));
  taken.clear();
  const Image& kept = image->pixels();
  ASSERT_TRUE(image->readRows(16, take));
  EXPECT_THAT(taken, ElementsAre(std::pair(0, 20u * 80u)));
  EXPECT_EQ(last, std::get<0>(kept.pixels).data()) << "what is kept is not decoded again";
}

TEST(SceneImage, ItsAlphaIsThatOfItsPixelsWhateverItsSize) {
  for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(8, 16), glm::ivec2(13, 9), glm::ivec2(7, 30)}) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(4 * size.x * size.y));
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * 37 + i / 251);
    const SceneImage image(Image{size.x, size.y, {"R", "G", "B", "A"}, pixels});
    const auto alpha = image.alpha();
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const auto texel = static_cast<std::size_t>(y * size.x + x);
        ASSERT_EQ(alpha->largest().at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)), pixels[4 * texel + 3]);
      }
    }
    EXPECT_EQ(image.alpha(), alpha) << "while someone holds it";
  }
}

TEST(SceneImage, CountsAFileThatIsLargerThanItsPixels) {
  const auto image = imageOf(pngOf(1, 7), "/images/0");
  EXPECT_GT(image->bytes(), 4u);
}

TEST(SceneImage, TellsOfDamageOnceItsPixelsWereAskedFor) {
  const SceneImages images{imageOf(pngOf(2, 1), "/images/0"), imageOf(brokenPng(3), "/images/1"),
                           imageOf(brokenPng(4), "/images/5")};
  EXPECT_THAT(damageOf(images), IsEmpty());
  EXPECT_TRUE(images[1]->readRows(16, [](int, std::span<const std::uint8_t>) {}));
  EXPECT_THAT(damageOf(images), ElementsAre(HasSubstr("/images/1")));
  EXPECT_TRUE(decodeImages(images, std::vector<int>{0, 1, 2}));
  EXPECT_THAT(damageOf(images), ElementsAre(HasSubstr("/images/1"), HasSubstr("/images/5")));
}

TEST(TextureImages, AreThoseOfTheMaterialsOnceForEachColorSpace) {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[0].baseColor = TextureUse{.image = 4};
  scene.materials[0].normal = TextureUse{.image = 4};
  scene.materials[1].emissive = TextureUse{.image = 4};
  scene.materials[1].metallicRoughness = TextureUse{.image = 2};
  scene.materials[2].occlusion = TextureUse{.image = 1};
  EXPECT_THAT(textureImages(scene, std::vector<int>{1, 0, 1}),
              ElementsAre(TextureImage{2, false}, TextureImage{4, false}, TextureImage{4, true}));
  EXPECT_THAT(textureImages(scene, {}), IsEmpty());
}

TEST(TextureImages, HolesAreReadOfMasksAndBlendsOnly) {
  Scene scene;
  scene.materials.resize(4);
  for (int i = 0; i < 4; ++i) scene.materials[static_cast<std::size_t>(i)].baseColor = TextureUse{.image = i};
  scene.materials[1].cutoff = 0.5f;
  scene.materials[2].cutoff = 0.5f;
  scene.materials[2].lightOpacity = 1.0f;
  scene.materials[3].lightOpacity = 0.5f;
  scene.primitives.resize(1);
  SceneView view;
  for (const int material : {2, 0, 1, 3, 2}) view.instances.emplace_back().material = material;
  EXPECT_THAT(alphaImages(scene, view), ElementsAre(1, 2));
}

} // namespace
} // namespace gnomon
