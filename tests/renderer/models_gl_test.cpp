// Every gathered model loads and shows something, or is refused by the name of the extension that it requires.
#include <nlohmann/json.hpp>
#include <set>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/gathered_scene.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
const fs::path kAssets = GNOMON_TEST_ASSETS;

std::size_t colorsIn(const Frame& frame) {
  const auto& pixels = std::get<std::vector<std::uint8_t>>(frame.images[0].image.pixels);
  const std::size_t channels = frame.images[0].image.channels.size();
  std::set<std::vector<std::uint8_t>> colors;
  for (std::size_t i = 0; i + channels <= pixels.size(); i += channels) {
    colors.emplace(pixels.begin() + static_cast<std::ptrdiff_t>(i),
                   pixels.begin() + static_cast<std::ptrdiff_t>(i + channels));
  }
  return colors.size();
}

TEST(Models, EveryOneIsShownOrRefusedByName) {
  if (!fs::exists(kAssets / "manifest.json")) GTEST_SKIP() << "no gathered models at " << kAssets;
  const auto manifest = nlohmann::json::parse(std::ifstream(kAssets / "manifest.json"));
  int shown = 0;
  for (const auto& model : manifest.at("models")) {
    SCOPED_TRACE(model.at("id").get<std::string>());
    const ScenePtr scene = testing::gatheredScene(kAssets, model);
    if (!scene) continue;
    const Frame frame = testing::renderJson(scene, R"({"width":64,"height":64,"antialiasing":"none"})");
    ASSERT_FALSE(frame.images.empty());
    EXPECT_GT(colorsIn(frame), 1u) << "blank";
    ++shown;
  }
  EXPECT_GE(shown, 40);
}

} // namespace
} // namespace gnomon
