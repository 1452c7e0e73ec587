#include "renderer/passes/gl_frame.h"

#include <optional>
#include <span>
#include <utility>

#include "protocol/spec/frame_lights.h"
#include "renderer/device/shader_data.h"
#include "renderer/gl/debug_log.h"
#include "renderer/passes/views/map_queries.h"
#include "renderer/passes/views/read_back.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {

namespace {

const SceneView& viewOf(const FrameWork& work) {
  return work.scene->scenes[static_cast<std::size_t>(work.frame.scene)];
}

/// What the passes of a frame returned.
struct PassResults {
  const Survey& survey;
  const ShadowAtlas& atlas;
  const DrawnViews& drawn;
  const GpuScene& gpu;
  std::span<const ViewRequest> views; ///< that were shown
};

PassReport passReport(const char* name, const gl::Timer& timer, std::uint64_t drawCalls, std::uint64_t triangles) {
  PassReport pass;
  pass.pass = name;
  pass.cpuMilliseconds = timer.cpuMilliseconds();
  pass.gpuMilliseconds = timer.gpuMilliseconds();
  pass.drawCalls = drawCalls;
  pass.triangles = triangles;
  return pass;
}

std::vector<PassReport> passReports(const PassResults& results) {
  const Survey& survey = results.survey;
  std::vector<PassReport> passes{passReport("survey", survey.timer, survey.drawCalls, survey.triangles)};
  if (results.atlas.timer.stopped()) {
    std::uint64_t triangles = 0;
    for (const TileCounts& tile : results.atlas.tiles) triangles += tile.casterTriangles;
    passes.push_back(passReport("shadow", results.atlas.timer, results.atlas.drawCalls, triangles));
  }
  for (const auto& [samples, surfaces] : results.drawn.surfaces) {
    passes.push_back(passReport("surfaces", surfaces.timer, surfaces.drawCalls, surfaces.triangles));
  }
  for (const auto& [samples, layers] : results.drawn.volumes) {
    passes.push_back(passReport("volumes", layers.timer, 0, 0));
  }
  for (const auto& [samples, sky] : results.drawn.skies) {
    passes.push_back(passReport("sky", sky.timer, 0, 0));
    passes.back().rays = sky.rays;
  }
  for (const auto& [samples, exact] : results.drawn.exactShadows) {
    passes.push_back(passReport("visibility", exact.timer, exact.drawCalls, exact.triangles));
  }
  for (std::size_t i = 0; i < results.drawn.views.size(); ++i) {
    const DrawnView& view = results.drawn.views[i];
    if (!view.timer.stopped()) continue; // read from a target that is there anyway
    passes.push_back(passReport("view", view.timer, 1, 1));
    passes.back().view = results.views[i].view;
  }
  return passes;
}

MemoryReport memoryOf(const PassResults& results) {
  MemoryReport memory;
  memory.scene = results.gpu.bytes + results.gpu.materialData.bytes();
  memory.atlas = results.atlas.textures->bytes();
  memory.targets = results.survey.depth.bytes();
  for (const auto& [samples, surfaces] : results.drawn.surfaces) memory.targets += surfaces.bytes();
  for (const auto& [samples, exact] : results.drawn.exactShadows) {
    memory.targets += exact.layers.texture.bytes() + exact.countBytes;
  }
  for (const auto& [samples, sky] : results.drawn.skies) memory.targets += sky.texture.bytes();
  for (const auto& [samples, layers] : results.drawn.volumes) memory.targets += layers.picture.bytes();
  memory.targets += results.drawn.casters.bytes() + results.drawn.flatAtlas.bytes();
  for (const DrawnView& view : results.drawn.views) memory.targets += view.color.bytes();
  return memory;
}

TileFacts tileFacts(const TileCounts& counts) {
  TileFacts facts{counts.casterTriangles, counts.culledTriangles, counts.drawCalls, counts.reused};
  if (counts.timer.stopped()) facts.time = WorkTime{counts.timer.cpuMilliseconds(), counts.timer.gpuMilliseconds()};
  return facts;
}

/// What they say of the frame, but for its stages. Reads the timers, so that it waits for the device if that is not
/// done.
FrameFacts factsOf(const PassResults& results) {
  FrameFacts facts;
  for (const TileCounts& counts : results.atlas.tiles) facts.tiles.push_back(tileFacts(counts));
  for (const auto& [samples, exact] : results.drawn.exactShadows) {
    facts.layers.insert(facts.layers.end(), exact.lights.begin(), exact.lights.end());
  }
  facts.passes = passReports(results);
  facts.surveyedTriangles = results.survey.triangles;
  for (const auto& [samples, surfaces] : results.drawn.surfaces) facts.shadedTriangles += surfaces.triangles;
  facts.otherDrawCalls = results.drawn.casters.drawCalls;
  facts.memory = memoryOf(results);
  return facts;
}

} // namespace

GlFrame::GlFrame(GlShared& shared, const FrameWork& work)
    : shared_(shared),
      work_(work),
      gpu_(shared.scenes.get(work.scene)),
      geometry_(frameGeometry(*work.scene, viewOf(work), work.frame.view.eye, work.frame.groups.ofInstance)),
      instances_(gl::bytesOf(instanceData(geometry_)), "instances"),
      vertices_(sceneVertices(gpu_, instances_)),
      anchored_(sceneVertices(gpu_, gpu_.anchored[static_cast<std::size_t>(work.frame.scene)])),
      data_(frameData(work.frame)),
      frame_(sizeof data_, "frame"),
      inputs_{.scene = *work.scene,
              .view = viewOf(work),
              .gpu = gpu_,
              .geometry = geometry_,
              .camera = work.frame.view,
              .frame = frame_,
              .instances = instances_,
              .vertices = vertices_,
              .anchored = anchored_,
              .programs = shared.programs,
              .width = work.frame.spec.width,
              .height = work.frame.spec.height,
              .nodes = work.frame.nodes,
              .edges = work.needsEdges ? std::span(shared.scenes.edges(work.scene)) : std::span<const EdgeMesh>{},
              .receiverGroups = work.frame.groups.matter()} {
  frame_.update(0, gl::bytesOfValue(data_));
  endStage("upload");
}

Result<SeenDepths> GlFrame::survey() {
  if (const FrameEnvironment* around = work_.environment) {
    if (around->environment) inputs_.environment = &shared_.environments.get(around->environment);
    setEnvironment(*around, data_);
    frame_.update(0, gl::bytesOfValue(data_));
  }
  auto survey = surveyScene(inputs_, samplesOf(work_.frame.spec.antialiasing), work_.parts);
  if (!survey) return survey.problems();
  survey_ = std::move(*survey);
  if (const DepthSpan& range = survey_.seen.all.range; !range.empty()) {
    data_.nearest = range.nearest;
    data_.farthest = range.farthest;
    frame_.update(0, gl::bytesOfValue(data_));
  }
  return survey_.seen;
}

Status GlFrame::cast(const ShowInput& input, TileUse tiles) {
  TileCache none(0);
  auto atlas = castShadows(inputs_, input.plan, work_.frame.spec, tiles == TileUse::kept ? shared_.tiles : none);
  if (!atlas) return atlas.problems();
  atlas_ = std::move(*atlas);
  draws_ = atlas_.drawCalls > 0; // none where every tile was kept
  return Done{};
}

Shading GlFrame::shadingOf(const ShowInput& input, const LightBuffers& buffers) const {
  return {work_.frame.spec, survey_, atlas_, input.lights, buffers, !input.lightLists.empty(), input.debugLight, {}};
}

/// As many of the baked lights as surfaces have room for, all of one layout; the others get layers.
BakedShading GlFrame::bakedShading() {
  BakedShading shading{{}, static_cast<int>(work_.layered.size())};
  for (; shading.maps.size() < GNOMON_LIGHT_MAPS && shading.firstLayer > 0; --shading.firstLayer) {
    const int light = work_.layered[static_cast<std::size_t>(shading.firstLayer) - 1];
    if (!techniqueOf(work_.frame, light).baked) break;
    const std::shared_ptr<const BakedLight> baked = work_.baked(light);
    if (baked->map.shares.empty()) break; // of a scene without surfaces
    const GpuLightMap& map = shared_.lightMaps.get(baked, inputs_.scene, inputs_.view);
    if (!shading.maps.empty() && shading.maps.front()->scene != map.scene) break;
    shading.maps.insert(shading.maps.begin(), &map);
  }
  return shading;
}

Status GlFrame::show(const ShowInput& input) {
  shown_.emplace(input);
  const LightBuffers buffers = uploadLights(input.lights, input.plan, input.lightLists);
  Shading shading = shadingOf(input, buffers);
  shading.baked = bakedShading();
  auto drawn = drawViews(inputs_, shading, work_, input);
  if (!drawn) return drawn.problems();
  drawn_ = std::move(*drawn);
  draws_ = true;
  return Done{};
}

Result<std::vector<PlacedTriangle>> GlFrame::shownTriangles() {
  const auto drawn = drawn_.surfaces.find(1);
  const bool numbered = drawn != drawn_.surfaces.end() && drawn->second.triangleNumbers.id() != 0;
  std::optional<Surfaces> own;
  if (!numbered) {
    auto surfaces = drawSurfaces(inputs_, survey_, 1, {.numbered = true});
    if (!surfaces) return surfaces.problems();
    own = std::move(*surfaces);
  }
  const Surfaces& surfaces = numbered ? drawn->second : *own;
  const auto numbers = gnomon::shownTriangles(inputs_, surfaces);
  if (!numbers) return numbers.problems();
  const auto width = static_cast<std::size_t>(inputs_.width);
  const auto height = static_cast<std::size_t>(inputs_.height);
  std::vector<PlacedTriangle> triangles(numbers->size());
  for (std::size_t row = 0; row < height; ++row) {
    surfaces.numbers.of(std::span(*numbers).subspan((height - 1 - row) * width, width),
                        std::span(triangles).subspan(row * width, width));
  }
  return triangles;
}

Result<std::vector<MapFootprint>> GlFrame::footprints(const ShowInput& input) {
  const LightBuffers buffers = uploadLights(input.lights, input.plan);
  return mapFootprints(inputs_, shadingOf(input, buffers), drawn_.surfaces.at(1));
}

Result<std::vector<float>> GlFrame::probe(const ShowInput& input, std::span<const ProbePoint> points) {
  const LightBuffers buffers = uploadLights(input.lights, input.plan);
  return probeShadow(inputs_, shadingOf(input, buffers), points);
}

Image GlFrame::picture(std::size_t index) {
  const ViewRequest& request = shown_->views[index];
  const gl::Texture& depths = drawn_.flatAtlas.id() != 0 ? drawn_.flatAtlas : atlas_.textures->depth;
  if (request.view == View::atlas) return readAtlas(depths, shown_->plan, request);
  if (request.view == View::tile) return readTile(depths, *shown_->tile, request);
  return readView(drawn_.views[index], request);
}

void GlFrame::endStage(std::string name) {
  // A stage that only read back has waited for the device.
  std::exchange(draws_, false) ? clock_.finishDrawing(std::move(name)) : clock_.finish(std::move(name));
}

Result<FrameFacts> GlFrame::finish() {
  if (const Status clean = gl::checkErrors("rendering a frame"); !clean) return clean.problems();
  FrameFacts facts = factsOf({survey_, atlas_, drawn_, gpu_, shown_ ? shown_->views : std::span<const ViewRequest>{}});
  if (inputs_.environment != nullptr) facts.memory.scene += inputs_.environment->bytes();
  facts.stages = clock_.take();
  return facts;
}

} // namespace gnomon
