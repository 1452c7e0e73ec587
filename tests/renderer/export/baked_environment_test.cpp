#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "protocol/spec/debug_light.h"
#include "renderer/core/light.h"
#include "renderer/environment/make_environment.h"
#include "renderer/environment/sky_model.h"
#include "renderer/export/baked_glb.h"
#include "renderer/export/export_files.h"
#include "renderer/frame/baked_scene.h"
#include "renderer/frame/render_frame.h"
#include "renderer/image/image_codec.h"
#include "renderer/scene/gltf_loader.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/environment/made_maps.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

using nlohmann::json;

FrameSpec skyAlone() {
  FrameSpec spec;
  spec.lights.emplace();
  spec.shadow.lightMap.size = 64;
  spec.environment.shadows = EnvironmentShadows::rays;
  return spec;
}

/// The light that a GLB's map holds at its brightest texel, and at its darkest.
struct MapLight {
  glm::dvec3 most{0}, least{HUGE_VAL};
};

MapLight lightIn(const Bytes& glb) {
  const auto number = [&](std::size_t at) { return littleEndian(std::span(glb).subspan(at, 4)); };
  const std::size_t jsonSize = number(12);
  const json document = json::parse(glb.begin() + 20, glb.begin() + 20 + static_cast<std::ptrdiff_t>(jsonSize));
  const json& map = document["materials"][0]["extensions"]["MOZ_lightmap"];
  const json& image =
      document["images"][document["textures"][map["index"].get<std::size_t>()]["source"].get<std::size_t>()];
  const json& view = document["bufferViews"][image["bufferView"].get<std::size_t>()];
  const std::size_t first = 20 + jsonSize + 8 + view.value("byteOffset", std::size_t{0});
  const auto picture = decodeImage(std::span(glb).subspan(first, view["byteLength"].get<std::size_t>()), 8192, 1 << 26);
  const auto& pixels = std::get<std::vector<std::uint8_t>>(picture->pixels);
  MapLight light;
  const std::size_t channels = picture->channels.size();
  for (std::size_t i = 0; i < pixels.size(); i += channels) {
    glm::dvec3 texel;
    for (std::size_t c = 0; c < 3; ++c) {
      const double srgb = pixels[i + c] / 255.0; // IEC 61966-2-1
      texel[static_cast<int>(c)] =
          map["intensity"].get<double>() * (srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
    }
    light.most = glm::max(light.most, texel);
    light.least = glm::min(light.least, texel);
  }
  return light;
}

class BakedEnvironmentTest : public ::testing::Test {
 protected:
  BakedScene bake(const FrameSpec& spec) {
    auto baked = bakeScene(caches_, open_, spec, {});
    EXPECT_TRUE(baked) << baked.problems().front().detail;
    return *std::move(baked);
  }

  const ScenePtr open_ = *loadGltf(testing::plane().bundle());
  FrameCaches caches_{TracedSceneCache(1 << 20), LightMapCache(1u << 28), VolumeCache(1u << 28)};
};

TEST_F(BakedEnvironmentTest, AnOpenPlaneGetsPiTimesAUniformRadianceInEveryTexel) {
  const glm::dvec3 radiance(0.5, 1, 2);
  FrameEnvironment around;
  around.environment =
      std::make_shared<const Environment>(makeEnvironment(testing::uniformMap(64, glm::vec3(radiance)), {}));
  around.intensity = 3;
  const BakedScene baked = bake(skyAlone());
  const ShadowedEnvironment environment{around, {}, *baked.environment.baked};
  const IrradianceMap map = irradianceMap(*open_, open_->scenes[0], {}, {}, &environment);
  const LightMapLayout& layout = *baked.environment.baked->layout;
  const Rect& rect = layout.charts.front().rect;
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    for (int x = rect.x; x < rect.x + rect.width; ++x) {
      const glm::dvec3 texel(map.texels[static_cast<std::size_t>(y * map.width + x)]);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(texel[c] / (std::numbers::pi * radiance[c] * 3), 1, 1e-3);
      EXPECT_EQ(map.texels[static_cast<std::size_t>(y * map.width + x)],
                map.texels[static_cast<std::size_t>(rect.y * map.width + rect.x)])
          << "without noise";
    }
  }
}

TEST_F(BakedEnvironmentTest, AGlbHasTheStudioOfAmbient) {
  FrameSpec spec = skyAlone();
  spec.ambient.color = Vec3{1, 0.5, 0.25};
  spec.ambient.intensity = 0.6;
  spec.environment.studio = Studio::even;
  spec.environment.intensity = 2;
  const auto file = bakeFile(bake(spec), BakeFile::glb, {});
  ASSERT_TRUE(file);
  const double up = double{shared::irradianceOfEvenStudio(1.0f)} * std::numbers::pi * 0.6 * 2;
  const MapLight light = lightIn(*file);
  EXPECT_NEAR(light.most.r, up, 0.01 * up);
  EXPECT_NEAR(light.most.g, 0.5 * up, 0.02 * up);
  EXPECT_NEAR(light.most.b, 0.25 * up, 0.02 * up);
  SceneBundle bundle;
  bundle.model = *file;
  EXPECT_TRUE(loadGltf(bundle));
}

TEST_F(BakedEnvironmentTest, AGlbHasSkyAndSun) {
  FrameSpec spec = skyAlone();
  spec.lights.reset();
  spec.shadow.technique = ShadowTechnique::lightMap;
  Sky sky;
  sky.sun.elevationDegrees = 50;
  spec.environment.sky = sky;
  const BakedScene baked = bake(spec);
  ASSERT_FALSE(baked.lights.empty()) << "the sky's sun";
  ASSERT_TRUE(baked.environment.baked);
  EXPECT_EQ(baked.environment.baked->layout, baked.found[static_cast<std::size_t>(baked.lights.back())].baked->layout);
  const auto both = bakeFile(baked, BakeFile::glb, {});
  const auto sunAlone = bakeFile(baked, BakeFile::glb, baked.lights.back());
  const auto rest = bakeFile(baked, BakeFile::glb, kEnvironmentLight);
  ASSERT_TRUE(both && sunAlone && rest);
  const glm::dvec3 open =
      std::numbers::pi * kUsualSkyIntensity *
      glm::dvec3(shared::environmentIrradiance(baked.around.environment->prefiltered.texels.data(), {0, 1, 0}));
  const glm::dvec3 sun = sunOf(sky)->irradiance * kUsualSkyIntensity * std::sin(glm::radians(50.0));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(lightIn(*rest).most[c] / open[c], 1, 0.02) << c;
    EXPECT_NEAR(lightIn(*sunAlone).most[c] / sun[c], 1, 0.02) << c;
    EXPECT_NEAR(lightIn(*both).most[c] / (sun[c] + open[c]), 1, 0.02) << c;
  }
}

TEST_F(BakedEnvironmentTest, PicturesAreOfItsSharesAndProblemsNameIt) {
  const BakedScene baked = bake(skyAlone());
  for (const std::optional<int> light : {std::optional<int>(), std::optional(kEnvironmentLight)}) {
    const auto png = bakeFile(baked, BakeFile::png, light);
    ASSERT_TRUE(png);
    const auto picture = decodeImage(*png, 8192, 1 << 26);
    ASSERT_TRUE(picture);
    const auto& pixels = std::get<std::vector<std::uint8_t>>(picture->pixels);
    EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](std::uint8_t value) { return value == 255; }));
  }
  const auto exr = bakeFile(baked, BakeFile::exr, {});
  ASSERT_TRUE(exr);
  EXPECT_NE(asText(*exr).find("environment.G"), std::string_view::npos);
  const auto none = bakeFile(baked, BakeFile::glb, 0);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.problems().front().pointer, "/light");
  FrameSpec withLight = skyAlone();
  withLight.environment.shadows = EnvironmentShadows::none;
  withLight.lights->emplace_back();
  withLight.shadow.technique = ShadowTechnique::lightMap;
  const auto without = bakeFile(bake(withLight), BakeFile::png, kEnvironmentLight);
  ASSERT_FALSE(without);
  EXPECT_EQ(without.problems().front().actual, "environment");
}

} // namespace
} // namespace gnomon
