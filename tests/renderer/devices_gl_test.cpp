// The processor's frames against OpenGL's: the demo, the city and the gathered scenes, from several cameras.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/gathered_scene.h"
#include "tests/renderer/made_grids.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

Renderer madeFor(DeviceChoice device) {
  auto renderer = Renderer::create({.backend = {.device = device}});
  if (!renderer) throw std::runtime_error(renderer.problems()[0].detail);
  return std::move(*renderer);
}

/// Each ends before the driver that was loaded for it, and so calls none that has been unloaded.
Renderer& rendererBy(DeviceChoice device) {
  static Renderer cpu = madeFor(DeviceChoice::cpu);
  static Renderer gl = madeFor(DeviceChoice::gl);
  return device == DeviceChoice::cpu ? cpu : gl;
}

struct Shown {
  std::string name;
  ScenePtr scene;
};

/// Of the gathered models, those that show much: of several files of one model the first that loads.
std::vector<Shown> everyScene() {
  std::vector<Shown> scenes{{"demo", testing::sceneOf(testing::readFile(GNOMON_DEMO_SCENE))}};
  for (const char* name : {"city", "lights", "leaves", "normal_mapped"}) {
    scenes.push_back({name, testing::generatedScene(name)});
  }
  const fs::path assets = GNOMON_TEST_ASSETS;
  if (!fs::exists(assets / "manifest.json")) {
    std::printf("no gathered models at %s\n", assets.c_str());
    return scenes;
  }
  const auto manifest = nlohmann::json::parse(std::ifstream(assets / "manifest.json"));
  for (const auto& model : manifest.at("models")) {
    const auto id = model.at("id").get<std::string>();
    const std::string name = id.substr(0, id.find('/'));
    if (name == scenes.back().name || model.at("triangles_default_scene").get<long>() < 2000) continue;
    if (ScenePtr scene = testing::gatheredScene(assets, model)) scenes.push_back({name, scene});
  }
  return scenes;
}

Json specOf(int camera, const Json& more) {
  const double turns[] = {35, 215};
  Json spec = {{"width", 320},
               {"height", 180},
               {"camera", {{"orbit", {{"azimuthDegrees", turns[camera]}, {"elevationDegrees", 15 + 25 * camera}}}}},
               {"lights", {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 40}}}}}},
               {"ambient", {{"intensity", 0.3}}},
               {"environment", {{"studio", "even"}}},
               {"toneMapping", "aces"},
               {"antialiasing", "none"}};
  spec.merge_patch(more);
  return spec;
}

Frame drawn(DeviceChoice device, const ScenePtr& scene, const Json& json) {
  const auto spec = decodeFrameSpec(testing::withMaps(json).dump());
  EXPECT_TRUE(spec) << spec.problems()[0].pointer << ' ' << spec.problems()[0].detail;
  if (!spec) return {};
  auto frame = rendererBy(device).render(scene, *spec);
  EXPECT_TRUE(frame) << frame.problems()[0].pointer << ' ' << frame.problems()[0].detail;
  return frame ? std::move(*frame) : Frame{};
}

struct Pair {
  Frame cpu, gl;
};

Pair bothOf(const ScenePtr& scene, const Json& spec) {
  Pair pair{drawn(DeviceChoice::cpu, scene, spec), drawn(DeviceChoice::gl, scene, spec)};
  EXPECT_EQ(pair.cpu.report.spec.device, DeviceChoice::cpu);
  EXPECT_EQ(pair.gl.report.spec.device, DeviceChoice::gl);
  return pair;
}

/// A pixel's greatest difference over its channels, in levels of 255.
std::vector<int> levelsBetween(const Frame& a, const Frame& b) {
  const Image& first = a.images.at(0).image;
  const auto& left = std::get<std::vector<std::uint8_t>>(first.pixels);
  const auto& right = std::get<std::vector<std::uint8_t>>(b.images.at(0).image.pixels);
  const std::size_t channels = first.channels.size();
  std::vector<int> levels(left.size() / channels);
  for (std::size_t i = 0; i < left.size(); ++i) {
    levels[i / channels] = std::max(levels[i / channels], std::abs(int(left[i]) - int(right[i])));
  }
  return levels;
}

double percentOver(const std::vector<int>& levels, int over) {
  const auto count = std::count_if(levels.begin(), levels.end(), [over](int level) { return level > over; });
  return 100.0 * static_cast<double>(count) / static_cast<double>(levels.size());
}

void expectSame(const Pair& pair) {
  const std::vector<int> levels = levelsBetween(pair.cpu, pair.gl);
  EXPECT_LE(percentOver(levels, 4), 1);
  EXPECT_LE(percentOver(levels, 16), 0.3);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

/// How many pixels of every scene differ by more than 4 and by more than 16 levels, as a table.
struct Differences {
  std::vector<double> over4, over16;

  explicit Differences(const Json& more) {
    for (const Shown& shown : everyScene()) {
      for (const int camera : {0, 1}) {
        const Pair pair = bothOf(shown.scene, specOf(camera, more));
        const std::vector<int> levels = levelsBetween(pair.cpu, pair.gl);
        over4.push_back(percentOver(levels, 4));
        over16.push_back(percentOver(levels, 16));
        std::printf("%-26s %d  over 4: %.4f %%, over 16: %.4f %%, most %d\n", shown.name.c_str(), camera, over4.back(),
                    over16.back(), *std::max_element(levels.begin(), levels.end()));
      }
    }
    std::printf("%zu pictures, median %.4f %% and %.4f %%, worst %.4f %% and %.4f %%\n", over4.size(), median(over4),
                median(over16), worst(over4), worst(over16));
  }

  static double worst(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
};

void expectSamePictures(const char* technique) {
  const Differences of(Json{{"shadow", {{"technique", technique}}}});
  EXPECT_LE(median(of.over4), 0.1);
  EXPECT_LE(median(of.over16), 0.01);
  EXPECT_LE(Differences::worst(of.over4), 1);
  EXPECT_LE(Differences::worst(of.over16), 0.3);
}

TEST(Devices, D5_D6_VolumesAreTheSame) {
  const auto hill = [](int x, int y, int z) {
    const int dx = x - 6, dz = z - 6;
    return std::max(0, 255 - 7 * (dx * dx + y * y / 2 + dz * dz));
  };
  SceneBundle bundle{testing::readFile(GNOMON_DEMO_SCENE), {}};
  bundle.files["hill.npy"] = testing::byteGrid(12, 12, 12, hill);
  const ScenePtr scene = testing::sceneOf(bundle);
  ASSERT_TRUE(scene);
  const Json volumes = Json::parse(R"([{"file": "hill.npy", "box": {"min": [-40, 8, -40], "max": [40, 30, 40]},
      "transferFunction": [{"value": 0, "extinction": 0}, {"value": 255, "color": [1, 0.9, 0.8], "extinction": 0.3}]}])");
  for (const int camera : {0, 1}) {
    for (const char* antialiasing : {"none", "msaa4x"}) {
      const Json more{{"volumes", volumes}, {"antialiasing", antialiasing}};
      const Pair pair = bothOf(scene, specOf(camera, more));
      SCOPED_TRACE(std::to_string(camera) + antialiasing);
      expectSame(pair);
      Json clear = specOf(camera, more);
      clear.erase("volumes");
      const Frame without = drawn(DeviceChoice::cpu, scene, clear);
      EXPECT_GT(percentOver(levelsBetween(without, pair.cpu), 16), 1);
    }
  }
}

TEST(Devices, N5_PicturesOfLightMapsAreTheSame) {
  for (const char* const name : {"box_on_plane", "double_sided", "mirrored_node"}) {
    const ScenePtr scene = testing::generatedScene(name);
    for (const int camera : {0, 1}) {
      for (const char* const antialiasing : {"none", "msaa4x"}) {
        SCOPED_TRACE(std::string(name) + ' ' + std::to_string(camera) + antialiasing);
        const Json shadow{{"technique", "lightMap"}, {"lightMap", {{"size", 512}}}};
        expectSame(bothOf(scene, specOf(camera, {{"shadow", shadow}, {"antialiasing", antialiasing}})));
      }
    }
  }
}

/// More maps than surfaces have room for, one that lies in another way, and techniques that have layers of their own.
TEST(Devices, N5_ManyLightMapsBesideOtherTechniquesAreTheSame) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  const auto sun = [](int azimuth, const Json& shadow) {
    return Json{{"type", "directional"},
                {"sun", {{"azimuthDegrees", azimuth}, {"elevationDegrees", 40}}},
                {"intensity", 0.5},
                {"shadow", shadow}};
  };
  const Json traced{{"technique", "rayTraced"}}, map{{"technique", "shadowMap"}};
  const auto baked = [](int size) { return Json{{"technique", "lightMap"}, {"lightMap", {{"size", size}}}}; };
  const std::vector<Json> casts[] = {
      {baked(256), traced, baked(256)},
      {baked(300), baked(256), baked(256), traced, baked(256), baked(256), baked(256), map},
      {baked(256), baked(256), traced, baked(300)},
  };
  for (const std::vector<Json>& shadows : casts) {
    Json lights = Json::array();
    for (const Json& shadow : shadows) lights.push_back(sun(40 * static_cast<int>(lights.size()), shadow));
    for (const char* const antialiasing : {"none", "msaa4x"}) {
      SCOPED_TRACE(std::to_string(shadows.size()) + antialiasing);
      expectSame(bothOf(scene, specOf(1, {{"lights", lights}, {"antialiasing", antialiasing}})));
    }
    for (std::size_t light = 0; light < shadows.size(); ++light) {
      Json spec = specOf(1, {{"lights", lights}, {"views", {"shadow"}}});
      spec["debug"]["light"] = light;
      const Pair pair = bothOf(scene, spec);
      EXPECT_LE(percentOver(levelsBetween(pair.cpu, pair.gl), 16), 0.5) << shadows.size() << ' ' << light;
    }
  }
}

TEST(Devices, PicturesOfExactShadowsAreTheSame) {
  expectSamePictures("rayTraced");
}

TEST(Devices, PicturesOfShadowMapsAreNearlyTheSame) {
  const Differences of(Json{{"shadow", {{"technique", "shadowMap"}}}});
  EXPECT_LE(median(of.over4), 0.5);
  EXPECT_LE(median(of.over16), 0.1);
}

TEST(Devices, N6_PicturesOfPenumbrasAreNearlyTheSame) {
  const Json sun = {{"type", "directional"},
                    {"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 40}}},
                    {"angularDiameterDegrees", 2}};
  for (const Json& shadow : {Json{{"filter", {{"type", "pcss"}}}}, Json{{"technique", "rayTraced"}}}) {
    const Differences of(Json{{"lights", {sun}}, {"shadow", shadow}});
    EXPECT_LE(median(of.over4), 0.5) << shadow;
    EXPECT_LE(median(of.over16), 0.1) << shadow;
  }
}

TEST(Devices, AntialiasedEdgesAreNearlyTheSame) {
  double all = 0, near = 0;
  for (const Shown& shown : everyScene()) {
    const Json exact = {{"shadow", {{"technique", "rayTraced"}}}};
    const Json spec = specOf(0, exact);
    Json smooth = spec;
    smooth["antialiasing"] = "msaa4x";
    const Pair pair = bothOf(shown.scene, smooth);
    const std::vector<int> between = levelsBetween(pair.cpu, pair.gl);
    // An edge is where antialiasing changes the picture.
    const Frame rough = drawn(DeviceChoice::gl, shown.scene, spec);
    const std::vector<int> smoothed = levelsBetween(rough, pair.gl);
    double edges = 0, close = 0;
    for (std::size_t i = 0; i < between.size(); ++i) {
      if (smoothed[i] <= 4) continue;
      ++edges;
      close += between[i] <= 32 ? 1 : 0;
    }
    std::printf("%-26s %6.0f edge pixels, %.3f %% within 32 levels\n", shown.name.c_str(), edges,
                edges > 0 ? 100 * close / edges : 100);
    all += edges;
    near += close;
  }
  EXPECT_GT(all, 1000);
  EXPECT_GE(near / all, 0.99);
}

/// The share of a view's numbers that differ by more than `allowed`, which is of the greater of 1 and the number.
double shareBeyond(const std::vector<float>& a, const std::vector<float>& b, double allowed) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue; // infinite, too
    const double apart = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    beyond += apart <= allowed * std::max(1.0, std::abs(static_cast<double>(b[i]))) ? 0 : 1;
  }
  return static_cast<double>(beyond) / static_cast<double>(a.size());
}

TEST(Devices, NumbersOfViewsAreTheSame) {
  std::vector<double> depths, normals, shadows;
  for (const Shown& shown : everyScene()) {
    const Json asked = {{"views", {"depth", "normal", "shadow"}},
                        {"shadow", {{"technique", "rayTraced"}}},
                        {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
    const Pair pair = bothOf(shown.scene, specOf(1, asked));
    const auto share = [&](std::size_t view, double allowed) {
      return 100 * shareBeyond(testing::floatsOf(pair.cpu, view), testing::floatsOf(pair.gl, view), allowed);
    };
    depths.push_back(share(0, 1e-3));
    normals.push_back(share(1, 1e-2));
    shadows.push_back(share(2, 1e-2));
    std::printf("%-26s beyond: depth %.4f %%, normal %.4f %%, shadow %.4f %%\n", shown.name.c_str(), depths.back(),
                normals.back(), shadows.back());
  }
  for (const auto& shares : {depths, normals, shadows}) EXPECT_LE(median(shares), 0.1);
  EXPECT_LE(Differences::worst(depths), 1);
  EXPECT_LE(Differences::worst(shadows), 1);
  // OpenGL chooses the size of a normal map for two by two pixels, the processor for each.
  EXPECT_LE(Differences::worst(normals), 5);
}

} // namespace
} // namespace gnomon
