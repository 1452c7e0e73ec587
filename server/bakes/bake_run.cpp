#include "server/bakes/bake_run.h"

#include <algorithm>

#include "protocol/bake/bake_json.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

std::size_t longerSide(const Shadow& shadow) {
  if (!traitsOf(shadow.technique).baked) {
    return 0;
  }
  const LightMapOptions& options = shadow.lightMap;
  return static_cast<std::size_t>(options.texelsPerMetre ? kLimits.maxLightMapSide : options.size);
}

Problem lateProblem(std::chrono::milliseconds timeout) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout).count();
  return {ProblemCode::deadlineExceeded, "", "The bake was not finished before its deadline.",
          std::to_string(seconds) + " seconds", ""};
}

Problem noMemory() {
  return {ProblemCode::busy, "", "Other frames in progress use all the memory for frames.", "", ""};
}

} // namespace

std::size_t bakeBytes(const FrameSpec& spec) {
  constexpr std::size_t kTexel = 6; ///< its share while it is found, and in the map
  std::size_t side = longerSide(spec.shadow);
  if (spec.lights) {
    for (const Light& light : *spec.lights) {
      side = std::max(side, light.shadow ? longerSide(*light.shadow) : 0);
    }
  }
  return side * side * kTexel;
}

BakeRun::BakeRun(BakeContext& context, LoadedScene scene, const FrameSpec& spec, Clock::time_point deadline)
    : context_(context),
      scene_(std::move(scene)),
      spec_(bakedParts(spec)),
      name_{scene_.summary.id, bakeKey(scene_.summary.id, spec)},
      deadline_(deadline),
      memory_(context.frameMemory) {}

BakeRun::~BakeRun() {
  context_.running.release();
}

Result<std::shared_ptr<BakeRun>> BakeRun::start(BakeContext& context, LoadedScene scene, const FrameSpec& spec,
                                                Clock::time_point deadline) {
  const std::size_t bytes = bakeBytes(spec);
  if (bytes > context.frameMemory.total()) {
    return Problem{ProblemCode::tooLarge, "/shadow/lightMap", "The light maps of this bake may be too large.",
                   std::to_string(context.frameMemory.total()) + " bytes", std::to_string(bytes) + " bytes"};
  }
  if (!context.running.try_acquire()) {
    return Problem{ProblemCode::busy, "", "The most bakes that may run at once are running.", "", ""};
  }
  std::shared_ptr<BakeRun> run(new BakeRun(context, std::move(scene), spec, deadline)); // releases `running` at its end
  if (!run->memory_.grow(bytes)) {
    return noMemory();
  }
  return run;
}

Result<BakeReport> BakeRun::report(const std::function<bool()>& gone, const BakeListener& listener) {
  const auto removed = context_.book.begin(name_, spec_);
  auto report = context_.baker.bake(scene_.scene, spec_, [&](BakeStep step) {
    step.key = name_.key;
    return !*removed && Clock::now() < deadline_ && !gone() && (!listener || listener(step));
  });
  context_.book.end(name_, bool(report));
  if (report) {
    report->key = name_.key;
  } else if (Clock::now() >= deadline_) {
    return lateProblem(context_.timeout);
  }
  return report;
}

Result<Bytes> bakedFile(BakeContext& context, const LoadedScene& scene, const FrameSpec& spec, BakeFile kind,
                        std::optional<int> light, const std::function<bool()>& gone) {
  constexpr std::size_t kParts = 4; ///< the map, its light in floats, the picture and its file
  const auto deadline = Clock::now() + context.timeout;
  ByteLease memory(context.frameMemory);
  if (!memory.grow(std::min(kParts * bakeBytes(spec), context.frameMemory.total()))) {
    return noMemory();
  }
  auto file = context.baker.file(scene.scene, spec, kind, light,
                                 [&](const BakeStep&) { return Clock::now() < deadline && !gone(); });
  if (!file && Clock::now() >= deadline) {
    return lateProblem(context.timeout);
  }
  return file;
}

} // namespace gnomon
