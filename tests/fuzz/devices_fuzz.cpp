// Small scenes and specs of anything that is hard to draw, drawn by the processor and by OpenGL: the same picture, or
// the same problem (what counts as the same: same_frames.h). GNOMON_FUZZ_SAVE=FOLDER writes the scene, the spec, both
// reports and both pictures of an input.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "protocol/json/json_codec.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"
#include "renderer/render.h"
#include "tests/fuzz/sound_problems.h"
#include "tests/support/chosen_spec.h"
#include "tests/support/same_frames.h"

namespace {

using namespace gnomon;
using nlohmann::json;

Renderer made(DeviceChoice device) {
  auto renderer = Renderer::create(
      {.backend = {.device = device}, .gpuSceneBytes = 0, .tracedSceneBytes = 0, .tileCacheBytes = 1u << 20});
  if (!renderer) std::cerr << renderer.problems()[0].detail << '\n';
  fuzz::require(static_cast<bool>(renderer), "both devices can be opened");
  return std::move(*renderer);
}

Renderer& rendererBy(DeviceChoice device) {
  static Renderer cpu = made(DeviceChoice::cpu);
  if (device == DeviceChoice::cpu) return cpu;
  // It keeps the shaders of every input: megabytes each.
  constexpr int kInputs = 300;
  static std::optional<Renderer> gl;
  static int left = 0;
  if (left-- == 0) {
    gl.reset();
    gl = made(DeviceChoice::gl);
    left = kInputs;
  }
  return *gl;
}

Result<Frame> drawn(DeviceChoice device, const ScenePtr& scene, FrameSpec spec) {
  spec.device = device;
  return rendererBy(device).render(scene, spec);
}

bool same(const Problems& a, const Problems& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Problem& left, const Problem& right) {
    return left.code == right.code && left.pointer == right.pointer && left.detail == right.detail;
  });
}

void save(const std::filesystem::path& folder, const Bytes& glb, const json& spec, const Result<Frame>& cpu,
          const Result<Frame>& gl) {
  const auto write = [&](const std::string& name, const auto& bytes) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  write("scene.glb", glb);
  write("spec.json", spec.dump(1));
  for (const auto& [name, frame] : {std::pair("cpu", &cpu), std::pair("gl", &gl)}) {
    if (!*frame) continue;
    write(std::string(name) + ".report.json", toJson((*frame)->report).dump(1));
    const auto pictures = encodePictures(**frame, 16);
    if (!pictures) continue;
    for (const EncodedPicture& picture : *pictures) write(std::string(name) + "." + picture.view, picture.file);
  }
}

} // namespace

/// What Mesa's software driver forgets of its shaders is not ours.
extern "C" const char* __lsan_default_suppressions(); // NOLINT: named by the sanitizer
extern "C" const char* __lsan_default_suppressions() {
  return "leak:swrast_dri.so\nleak:libgallium\n";
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  // Nearly all of an input's time goes into llvmpipe's compiling of shaders: without optimisation, and for narrow
  // vectors, it takes a quarter.
  setenv("GALLIVM_PERF", "nopt", 0);
  setenv("LP_NATIVE_VECTOR_WIDTH", "128", 0);
  setenv("LP_NUM_THREADS", "1", 0);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const testing::ChosenFrame chosen = testing::chosenFrame({data, size});
  const auto scene = loadScene({chosen.glb, {}});
  if (!scene) {
    fuzz::requireSound(scene.problems());
    return 0;
  }
  const auto spec = decodeFrameSpec(chosen.spec.dump());
  if (!spec) {
    fuzz::requireSound(spec.problems());
    return 0;
  }
  const auto cpu = drawn(DeviceChoice::cpu, *scene, *spec);
  const auto gl = drawn(DeviceChoice::gl, *scene, *spec);
  if (const char* folder = std::getenv("GNOMON_FUZZ_SAVE")) save(folder, chosen.glb, chosen.spec, cpu, gl);
  if (!cpu) fuzz::requireSound(cpu.problems());
  if (!gl) fuzz::requireSound(gl.problems());
  if (!placesOfShadowVolumes(*spec).empty()) {
    fuzz::require(!cpu, "the processor draws no shadow volumes");
    return 0;
  }
  fuzz::require(static_cast<bool>(cpu) == static_cast<bool>(gl), "both devices can draw a frame, or neither");
  if (!cpu) {
    fuzz::require(same(cpu.problems(), gl.problems()), "the same problems");
    return 0;
  }
  const std::string difference = testing::differenceOf(*cpu, *gl).what;
  fuzz::require(difference.empty(), difference.c_str());
  return 0;
}
