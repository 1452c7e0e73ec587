#include "renderer/cpu/cpu_frame.h"

#include <set>
#include <utility>

#include "protocol/base/elapsed.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"
#include "renderer/cpu/cast_tiles.h"
#include "renderer/cpu/shadow/read_texels.h"
#include "renderer/cpu/show/read_textures.h"

namespace gnomon::cpu {
namespace {

using Clock = std::chrono::steady_clock;

const SceneView& viewOf(const FrameWork& work) {
  return work.scene->scenes[static_cast<std::size_t>(work.frame.scene)];
}

std::uint64_t bytesOf(const DepthBuffer& buffer) {
  return buffer.depths.size() * sizeof(float) + buffer.triangles.size() * sizeof(std::uint32_t);
}

std::uint64_t bytesOf(const VolumeLayers& layers) {
  return layers.depths.size() * sizeof(float) + layers.picture.size() * sizeof(glm::vec4) +
         layers.shadow.size() * sizeof(std::uint16_t);
}

} // namespace

CpuFrame::CpuFrame(Shared& shared, const FrameWork& work)
    : shared_(shared),
      work_(work),
      cached_(shared.scenes.of(work.scene)),
      view_(viewOf(work)),
      geometry_(frameGeometry(*work.scene, view_, work.frame.view.eye, work.frame.groups.ofInstance)),
      scene_(frameScene(*work.scene, view_, geometry_, work.frame)),
      stageStart_(Clock::now()),
      passStart_(stageStart_) {
  endStage("upload");
}

CpuFrame::~CpuFrame() {
  if (bytesOf(survey_.buffer) <= shared_.mostStorage) {
    shared_.storage[survey_.buffer.samples] = std::move(survey_.buffer);
  }
}

CameraRaster CpuFrame::camera() const {
  return {scene_, work_.frame.view, work_.frame.nodes, *cached_.textures, masks_, nullptr, shared_.scratch};
}

CastInput CpuFrame::castInput(const ShadowPlan& plan) const {
  return {scene_,     *cached_.textures, plan,           work_.frame.spec, work_.frame.nodes,
          cached_.id, work_.frame.scene, shared_.scratch};
}

Status CpuFrame::needHoles() {
  std::vector<ReadTexture> holes;
  for (const int image : alphaImages(*work_.scene, view_)) holes.push_back({{image, true}});
  if (const Status made = cached_.textures->need(holes); !made) return made.problems();
  masks_ = cached_.coverages->of(*work_.scene, view_);
  return Done{};
}

const std::vector<ReadTexture>& CpuFrame::missingTextures(int samples) {
  const auto [found, isNew] = missing_.try_emplace(samples);
  if (!isNew) return found->second;
  std::vector<int> materials;
  for (std::size_t i = 0; i < scene_.slots.size(); ++i) {
    if (survey_.visible[i] != 0) materials.push_back(scene_.slots[i].material);
  }
  const std::vector<TextureImage> shown = textureImages(*work_.scene, materials);
  if (!cached_.textures->areMade(shown)) {
    found->second = readTextures(scene_, *cached_.textures, surfaces(samples), shown);
  }
  return found->second;
}

Result<SeenDepths> CpuFrame::survey() {
  if (const Status made = needHoles(); !made) return made.problems();
  if (const FrameEnvironment* around = work_.environment) {
    if (around->environment) scene_.environment = around->environment->prefiltered.texels.data();
    setEnvironment(*around, scene_.frame);
  }
  passStart_ = Clock::now();
  const int samples = gnomon::samplesOf(work_.frame.spec.antialiasing);
  survey_ = surveyScene(camera(), samples, work_.parts, std::exchange(shared_.storage[samples], {}));
  if (const DepthSpan& range = survey_.seen.all.range; !range.empty()) {
    scene_.frame.nearest = range.nearest;
    scene_.frame.farthest = range.farthest;
  }
  facts_.surveyedTriangles = survey_.triangles;
  endPass("survey", survey_.triangles);
  return survey_.seen;
}

DepthBuffer& CpuFrame::surfaces(int samples) {
  if (samples == survey_.buffer.samples) {
    facts_.shadedTriangles += surveyShown_ ? 0 : survey_.triangles;
    surveyShown_ = true;
    return survey_.buffer;
  }
  const auto found = otherSurfaces_.find(samples);
  if (found != otherSurfaces_.end()) return found->second;
  passStart_ = Clock::now();
  std::uint64_t triangles = 0;
  const auto made = otherSurfaces_.emplace(samples, rasterVisible(camera(), survey_, samples, triangles));
  facts_.shadedTriangles += triangles;
  endPass("surfaces", triangles);
  return made.first->second;
}

Status CpuFrame::cast(const ShowInput& input, TileUse tiles) {
  const auto textured = std::find_if(input.views.begin(), input.views.end(),
                                     [](const ViewRequest& request) { return traitsOf(request.view).material; });
  if (textured != input.views.end()) {
    decoding_ = cached_.textures->makeAhead(missingTextures(samplesOf(*textured)));
  }
  passStart_ = Clock::now();
  TileStore none(0);
  const ShadowPlan& plan = input.plan;
  cast_ = castTiles(castInput(plan), tiles == TileUse::kept ? shared_.tiles : none);
  facts_.tiles = cast_.facts;
  if (plan.atlasWidth == 0) return Done{};
  for (const ViewRequest& request : input.views) {
    if (traitsOf(request.view).shadowed) surfaces(samplesOf(request));
  }
  passStart_ = Clock::now();
  makeTexels(plan, readBy(input));
  std::uint64_t triangles = 0;
  for (const TileFacts& tile : cast_.facts) triangles += tile.casterTriangles;
  for (const auto& tile : cast_.tiles) facts_.memory.atlas += tile ? tile->bytes() : 0;
  endPass("shadow", triangles);
  return Done{};
}

/// The texels that views read of the plan's tiles, for each tile.
std::vector<TexelMarks> CpuFrame::readBy(const ShowInput& input) {
  std::vector<TexelMarks> read = noTexels(input.plan);
  const ShownLights lights(input.plan, input.lights, cast_);
  const ShadowMaps maps = lights.maps({});
  std::set<int> done;
  for (const ViewRequest& request : input.views) {
    if (request.view == View::atlas) {
      for (TexelMarks& tile : read) tile.markAll();
    } else if (request.view == View::tile) {
      read[static_cast<std::size_t>(input.tile - input.plan.tiles.data())].markAll();
    } else if (traitsOf(request.view).shadowed && done.insert(samplesOf(request)).second) {
      markReadTexels({scene_, surfaces(samplesOf(request)), maps, input.lightLists, input.debugLight}, read);
    }
  }
  return read;
}

void CpuFrame::makeTexels(const ShadowPlan& plan, std::span<const TexelMarks> read) {
  cpu::makeTexels(castInput(plan), read, cast_);
  facts_.tiles = cast_.facts;
}

void CpuFrame::endPass(const char* name, std::uint64_t triangles) {
  PassReport pass;
  pass.pass = name;
  pass.cpuMilliseconds = millisecondsSince(passStart_);
  pass.triangles = triangles;
  facts_.passes.push_back(std::move(pass));
}

void CpuFrame::endStage(std::string name) {
  facts_.stages.push_back({std::move(name), millisecondsSince(stageStart_)});
  stageStart_ = Clock::now();
}

Result<FrameFacts> CpuFrame::finish() {
  facts_.memory.scene = cached_.textures->bytes();
  facts_.memory.targets += bytesOf(survey_.buffer);
  for (const auto& [samples, buffer] : otherSurfaces_) facts_.memory.targets += bytesOf(buffer);
  for (const auto& [samples, layers] : layers_) facts_.memory.targets += layers.bytes();
  for (const auto& [samples, sky] : skies_) facts_.memory.targets += sky.values.size() * sizeof(sky.values[0]);
  for (const auto& [samples, layers] : volumes_) facts_.memory.targets += bytesOf(layers);
  return std::move(facts_);
}

} // namespace gnomon::cpu
