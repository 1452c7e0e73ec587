#include <algorithm>
#include <array>
#include <cstring>

#include "server/worker/render_thread.h"

namespace gnomon {
namespace {

/// A square of ground and, a metre above it, a smaller square; one index list serves both.
constexpr std::string_view kModel = R"({
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [0, 1, 0], "scale": [0.1, 1, 0.1]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
  "buffers": [{"byteLength": 60, "uri": "squares.bin"}],
  "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-5, 0, -5], "max": [5, 0, 5]},
    {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]
})";
constexpr std::array<float, 12> kCorners{-5, 0, -5, -5, 0, 5, 5, 0, 5, 5, 0, -5}; ///< metres
constexpr std::array<std::uint16_t, 6> kIndices{0, 1, 2, 0, 2, 3};                ///< counter-clockwise from above

SceneBundle firstBundle() {
  SceneBundle made;
  made.model.assign(kModel.begin(), kModel.end());
  Bytes buffer(sizeof kCorners + sizeof kIndices);
  std::memcpy(buffer.data(), kCorners.data(), sizeof kCorners);
  std::memcpy(buffer.data() + sizeof kCorners, kIndices.data(), sizeof kIndices);
  made.files.emplace("squares.bin", std::move(buffer));
  return made;
}

FrameSpec firstSpec() {
  FrameSpec made;
  made.width = 16;
  made.height = 16;
  made.camera.lookAt = EyeTarget{{0, 5, 0}, {0, 0, 0}, {0, 0, -1}};
  made.camera.perspective = Perspective{};
  Light sun;
  sun.sun = Sun{90, 45};
  made.lights = std::vector<Light>{sun};
  made.views = {View::shadow};
  return made;
}

/// True where some pixels are lit and some are not.
bool showsShadow(const Image& image) {
  return std::visit(
      [&](const auto& pixels) {
        if (pixels.empty() || image.channels.empty()) return false;
        auto darkest = pixels.front();
        auto brightest = pixels.front();
        for (std::size_t i = 0; i < pixels.size(); i += image.channels.size()) {
          darkest = std::min(darkest, pixels[i]);
          brightest = std::max(brightest, pixels[i]);
        }
        return darkest < brightest;
      },
      image.pixels);
}

} // namespace

Status drawFirstFrame(Renderer& renderer) {
  auto scene = loadScene(firstBundle());
  if (!scene) return std::move(scene).problems();
  auto frame = renderer.render(*scene, firstSpec());
  if (!frame) return std::move(frame).problems();
  if (frame->images.size() != 1 || !showsShadow(frame->images.front().image)) {
    return Problem{ProblemCode::backend, "", "The test frame that the renderer drew has no shadow in it.", "", ""};
  }
  return Done{};
}

} // namespace gnomon
