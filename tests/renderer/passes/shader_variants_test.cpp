#include "renderer/passes/shader_variants.h"

#include <gmock/gmock.h>

namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Not;

TEST(ShaderVariants, APlainMaterialAsksForNoTexture) {
  for (const std::string& define : shadeProgram(Material{}, {.lights = 1, .filterSize = 5}).defines) {
    EXPECT_EQ(define.find("TEXTURE"), std::string::npos) << define;
  }
}

TEST(ShaderVariants, DataViewsLeaveOutWhatTheyDoNotShow) {
  Material material;
  material.baseColor = TextureUse{0};
  material.normal = TextureUse{1, 1};
  const auto depth = shadeProgram(material, {.view = View::depth}).defines;
  EXPECT_THAT(depth, Not(Contains("BASE_COLOR_TEXTURE")));
  EXPECT_THAT(depth, Not(Contains("NORMAL_TEXTURE")));
  const auto normal = shadeProgram(material, {.view = View::normal}).defines;
  EXPECT_THAT(normal, Contains("NORMAL_TEXTURE"));
  EXPECT_THAT(normal, Contains("NORMAL_UV surface.uv1"));
  EXPECT_THAT(normal, Contains("UV1"));
  EXPECT_THAT(normal, Not(Contains("UV0")));
}

TEST(ShaderVariants, G2_AMaskIsCutInEveryView) {
  Material material;
  material.alphaMode = AlphaMode::mask;
  material.baseColor = TextureUse{0};
  for (const View view : {View::color, View::depth, View::normal, View::shadow, View::cascades}) {
    const auto defines = shadeProgram(material, {.view = view}).defines;
    EXPECT_THAT(defines, Contains("ALPHA_MASK"));
    EXPECT_THAT(defines, Contains("BASE_COLOR_TEXTURE"));
  }
  EXPECT_THAT(maskDefines(&material), Contains("BASE_COLOR_TEXTURE"));
  EXPECT_TRUE(maskDefines(nullptr).empty());
}

TEST(ShaderVariants, LinearPicturesAreNotToneMapped) {
  const auto linear = shadeProgram(Material{}, {.encoded = false}).defines;
  EXPECT_THAT(linear, Not(Contains("TONE_ACES")));
  EXPECT_THAT(linear, Not(Contains("ENCODED")));
}

TEST(ShaderVariants, FiltersThatDifferAreChosenInTheShader) {
  EXPECT_THAT(shadeProgram(Material{}, {.filterSize = 7}).defines, Contains("FILTER_SIZE 7"));
  EXPECT_THAT(shadeProgram(Material{}, {.filterSize = 0}).defines, Not(Contains("FILTER_SIZE 0")));
  EXPECT_THAT(shadeProgram(Material{}, {}).defines, Contains("NO_SHADOWS"));
}

} // namespace
} // namespace gnomon
