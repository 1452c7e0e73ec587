#include "renderer/cpu/cpu_frame.h"

#include "protocol/base/elapsed.h"
#include "protocol/spec/traits.h"
#include "renderer/cpu/show_view.h"
#include "renderer/device/view_image.h"
#include "renderer/prepare/named_tiles.h"

namespace gnomon::cpu {
namespace {

using Clock = std::chrono::steady_clock;

const SceneView& viewOf(const FrameWork& work) {
  return work.scene->scenes[static_cast<std::size_t>(work.frame.scene)];
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

CameraRaster CpuFrame::camera() const {
  return {scene_, work_.frame.view, work_.frame.nodes, nullptr, shared_.scratch};
}

CastInput CpuFrame::castInput(const ShadowPlan& plan) const {
  return {scene_, plan, work_.frame.spec, work_.frame.nodes, cached_.id, work_.frame.scene, shared_.scratch};
}

Result<ReceiverDepths> CpuFrame::survey() {
  passStart_ = Clock::now();
  survey_ = surveyScene(camera(), work_.frame.spec.antialiasing == Antialiasing::msaa4x ? 4 : 1);
  if (!survey_.receivers.range.empty()) {
    scene_.frame.depthRange.x = survey_.receivers.range.nearest;
    scene_.frame.depthRange.y = survey_.receivers.range.farthest;
  }
  facts_.surveyedTriangles = survey_.triangles;
  endPass("survey", survey_.triangles);
  return survey_.receivers;
}

Status CpuFrame::cast(const ShadowPlan& plan, TileUse tiles) {
  passStart_ = Clock::now();
  TileStore none(0);
  cast_ = castTiles(castInput(plan), tiles == TileUse::kept ? shared_.tiles : none);
  facts_.tiles = cast_.facts;
  if (plan.atlasWidth == 0) return Done{};
  std::uint64_t triangles = 0;
  for (const TileFacts& tile : cast_.facts) triangles += tile.casterTriangles;
  for (const auto& tile : cast_.tiles) facts_.memory.atlas += tile ? tile->bytes() : 0;
  endPass("shadow", triangles);
  return Done{};
}

const DepthBuffer& CpuFrame::surfaces(int samples) {
  if (samples == survey_.buffer.samples) return survey_.buffer;
  const auto found = otherSurfaces_.find(samples);
  if (found != otherSurfaces_.end()) return found->second;
  passStart_ = Clock::now();
  std::uint64_t triangles = 0;
  const auto made = otherSurfaces_.emplace(samples, rasterVisible(camera(), survey_, samples, triangles));
  endPass("surfaces", triangles);
  return made.first->second;
}

Status CpuFrame::needLayers(int samples) {
  if (work_.layered.empty() || layers_.contains(samples)) return Done{};
  const DepthBuffer& shown = surfaces(samples);
  passStart_ = Clock::now();
  auto made = exactLayers(camera(), work_, survey_, shown);
  if (!made) return made.problems();
  facts_.layers.insert(facts_.layers.end(), made->lights.begin(), made->lights.end());
  layers_.emplace(samples, std::move(*made));
  endPass("visibility", 0);
  return Done{};
}

namespace {

std::vector<TileMap> tileMaps(const ShadowPlan& plan, const CastTiles& cast) {
  std::vector<TileMap> maps;
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const RasteredTile* tile = cast.tiles[i].get();
    maps.push_back({plan.tiles[i].rect, tile ? &tile->depths : nullptr,
                    tile ? std::span<const glm::vec4>(tile->moments) : std::span<const glm::vec4>{}});
  }
  return maps;
}

/// The nearest depth of each texel, put into the atlas row by row from the bottom.
void addDepths(const ShadowTile& tile, const DepthBuffer& depths, const Rect& of, std::vector<float>& out) {
  for (int y = 0; y < tile.rect.height; ++y) {
    for (int x = 0; x < tile.rect.width; ++x) {
      float nearest = 1;
      for (int s = 0; s < depths.samples; ++s) nearest = std::min(nearest, depths.depths[depths.at(x, y, s)]);
      const auto at = static_cast<std::size_t>(tile.rect.y - of.y + y) * static_cast<std::size_t>(of.width) +
                      static_cast<std::size_t>(tile.rect.x - of.x + x);
      out[at] = nearest;
    }
  }
}

Image depthsIn(const ShadowPlan& plan, const CastTiles& cast, const Rect& rect, const ShadowTile* only, bool encoded) {
  std::vector<float> depths(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height), 1.0f);
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    const ShadowTile& tile = plan.tiles[i];
    if (cast.tiles[i] && (only == nullptr || only == &tile)) addDepths(tile, cast.tiles[i]->depths, rect, depths);
  }
  return depthImage(rect.width, rect.height, depths, encoded);
}

} // namespace

Image CpuFrame::atlasPicture(const ShowInput& input, const ViewRequest& request) const {
  if (request.view == View::tile) {
    return depthsIn(input.plan, cast_, input.tile->rect, input.tile, request.encoded);
  }
  Image image =
      depthsIn(input.plan, cast_, {0, 0, input.plan.atlasWidth, input.plan.atlasHeight}, nullptr, request.encoded);
  return request.encoded ? namedTiles(image, input.plan) : image;
}

Status CpuFrame::showOne(const ShowInput& input, const ViewRequest& request) {
  const ViewTraits& traits = traitsOf(request.view);
  if (traits.source == ViewSource::atlas) {
    pictures_.push_back(atlasPicture(input, request));
    return Done{};
  }
  const bool averaged = traits.source == ViewSource::picture && request.antialiased;
  const int samples = averaged ? survey_.buffer.samples : 1;
  if (traits.shadowed) {
    if (const Status there = needLayers(samples); !there) return there.problems();
  }
  const DepthBuffer& shown = surfaces(samples);
  passStart_ = Clock::now();
  std::vector<LitLight> own;
  if (request.fullStrength) own = atFullStrength({input.lights.begin(), input.lights.end()});
  const std::vector<shared::LightData> lights =
      lightData(request.fullStrength ? std::span<const LitLight>(own) : input.lights);
  const std::vector<shared::TileData> tiles = tileData(input.plan);
  const std::vector<TileMap> maps = tileMaps(input.plan, cast_);
  const auto exact = layers_.find(samples);
  const std::vector<Layer> layers = exact == layers_.end() ? std::vector<Layer>{} : exact->second.layers(shown);
  const ShadowMaps shadows{lights, tiles, maps, glm::vec2(input.plan.atlasWidth, input.plan.atlasHeight), layers};
  const ShowJob job{
      scene_,          shown, shadows, input.lightLists, request.view, request.encoded, work_.frame.spec.toneMapping,
      input.debugLight};
  pictures_.push_back(showView(job, request.opaque));
  endPass("view", 0);
  facts_.passes.back().view = request.view;
  return Done{};
}

Status CpuFrame::show(const ShowInput& input) {
  for (const ViewRequest& request : input.views) {
    if (const Status shown = showOne(input, request); !shown) return shown.problems();
  }
  return Done{};
}

Result<std::vector<MapFootprint>> CpuFrame::footprints(const ShowInput&) {
  return std::vector<MapFootprint>{};
}

Result<std::vector<float>> CpuFrame::probe(const ShowInput&, std::span<const ProbePoint>) {
  return std::vector<float>{};
}

Image CpuFrame::picture(std::size_t index) {
  return pictures_[index];
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
  return std::move(facts_);
}

} // namespace gnomon::cpu
