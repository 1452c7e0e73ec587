// A GLB's header and chunks, and the JSON in them against glTF's schema.
#include "renderer/scene/checks/gltf_schema.h"
#include "renderer/scene/container/json_text.h"
#include "renderer/scene/container/model_container.h"
#include "tests/fuzz/glb_parts.h"
#include "tests/fuzz/sound_problems.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t capacity);

namespace {

using namespace gnomon;

bool within(const std::uint8_t* part, std::size_t size, const Bytes& whole) {
  return part >= whole.data() && part + size <= whole.data() + whole.size();
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t capacity,
                                               unsigned seed) {
  return gnomon::fuzz::mutatePart(data, size, capacity, seed, LLVMFuzzerMutate);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes model(data, data + size);
  Findings findings;
  const auto container = openContainer(model, findings);
  if (!container) {
    fuzz::requireSound(container.problems());
    return 0;
  }
  const auto* text = reinterpret_cast<const std::uint8_t*>(container->json.data());
  fuzz::require(within(text, container->json.size(), model), "the JSON lies in the file");
  if (container->binary) {
    fuzz::require(within(container->binary->data(), container->binary->size(), model), "the binary lies in the file");
  }
  auto json = parseJsonText(container->json, kLimits);
  if (!json) {
    fuzz::requireSound(json.problems());
    return 0;
  }
  checkVersion(*json, findings);
  checkExtensions(*json, findings);
  checkSchema(*json, findings);
  if (findings.refused()) fuzz::requireSound(findings.takeProblems());
  return 0;
}
