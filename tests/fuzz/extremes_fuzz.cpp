// Files and requests with extreme numbers, drawn whole by the processor: a picture or a problem.
#include <optional>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/fuzz/sound_problems.h"
#include "tests/support/extreme_frame.h"

namespace {

using namespace gnomon;

Renderer& renderer() {
  static Renderer made = [] {
    auto created = Renderer::create(
        {.backend = {.device = DeviceChoice::cpu}, .gpuSceneBytes = 0, .tracedSceneBytes = 0, .tileCacheBytes = 0});
    fuzz::require(static_cast<bool>(created), "the processor can draw");
    return std::move(*created);
  }();
  return made;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const testing::ExtremeFrame frame = testing::extremeFrame({data, size});
  const auto spec = decodeFrameSpec(frame.spec.dump());
  const auto scene = loadScene(frame.bundle);
  if (!spec) fuzz::requireSound(spec.problems());
  if (!scene) fuzz::requireSound(scene.problems());
  if (!spec || !scene) return 0;
  const auto drawn = renderer().render(*scene, *spec);
  if (!drawn) fuzz::requireSound(drawn.problems());
  return 0;
}
