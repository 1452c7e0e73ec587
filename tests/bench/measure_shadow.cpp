// Holds shadows that other renderers drew against the exact ones, and Gnomon's own beside them: the same camera, the
// same pixels, the same measures. Gnomon draws by each of its devices. Prints JSON. other_renderers/ says who calls it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"
#include "renderer/evaluation/evaluation_measures.h"
#include "renderer/rays/traced_scene.h"
#include "renderer/reference/error_measures.h"
#include "renderer/render.h"
#include "renderer/resolve/resolve_frame.h"
#include "tests/bench/other_picture.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class Value>
Value orFail(Result<Value> result) {
  if (result) return std::move(*result);
  std::string text;
  for (const Problem& problem : result.problems()) text += problem.pointer + ": " + problem.detail + '\n';
  throw Failure(text);
}

struct Way {
  const char* name;
  nlohmann::json shadow;
};

/// Ways to make the shadow; each is laid over the spec.
std::vector<Way> ways() {
  const nlohmann::json hard = {{"type", "hard"}};
  return {{"default map", {{"technique", "shadowMap"}}},
          {"hard map", {{"technique", "shadowMap"}, {"filter", hard}}},
          {"hard map, XLarge", {{"technique", "shadowMap"}, {"filter", hard}, {"size", "XLarge"}}},
          {"rayTraced", {{"technique", "rayTraced"}}},
          {"shadowVolume", {{"technique", "shadowVolume"}}}};
}

FrameSpec specOf(nlohmann::json spec, const nlohmann::json& shadow) {
  spec["shadow"] = shadow;
  spec["antialiasing"] = "none";
  return orFail(decodeFrameSpec(spec.dump()));
}

FrameSpec shadowSpec(FrameSpec spec) {
  spec.views = {View::shadow};
  spec.output.format = ImageFormat::exr;
  return spec;
}

/// The one light's truth.
struct Truth {
  ResolvedFrame frame;
  glm::dvec3 anchor{0};
  Reference reference;
};

Truth truthOf(const ScenePtr& scene, const FrameSpec& spec) {
  ResolvedFrame frame = orFail(resolveFrame(*scene, spec));
  if (frame.spec.lights->size() != 1) throw Failure("A comparison is of one light's shadow.\n");
  const TracedScene traced = orFail(TracedScene::build(scene, frame.scene));
  const TraceInput input{traced, frame.view, spec.width, spec.height, *frame.spec.lights, frame.nodes};
  const int light = 0;
  Reference reference = orFail(traceReference(input, std::span(&light, 1), 1));
  return {std::move(frame), anchorOf(traced.view()), std::move(reference)};
}

/// Pixels that both show are what counts.
void leaveOut(Reference& truth, const Alignment& alignment) {
  std::vector<std::uint8_t>& receiver = truth.lights.front().receiver;
  for (std::size_t i = 0; i < receiver.size(); ++i) receiver[i] &= alignment.same[i];
}

nlohmann::json rowOf(const std::string& name, const Reference& truth, const std::vector<float>& shown) {
  EvaluationRow row;
  row.name = name;
  row.metrics = measureErrors(truth, std::span(&shown, 1));
  return nlohmann::json::parse(toJson(row).dump());
}

std::uint64_t receiversOf(const Reference& truth) {
  const std::vector<std::uint8_t>& receiver = truth.lights.front().receiver;
  return static_cast<std::uint64_t>(std::count(receiver.begin(), receiver.end(), std::uint8_t{1}));
}

/// Of the tiles that the shadow was drawn into.
std::int64_t texelsOf(const FrameReport& report) {
  std::int64_t texels = 0;
  for (const TileReport& cascade : report.lights.front().tiles) {
    texels += std::int64_t{cascade.tile[2]} * cascade.tile[3];
  }
  return texels;
}

double millisecondsOf(Renderer& renderer, const ScenePtr& scene, const FrameSpec& spec) {
  double whole = 0;
  for (const StageTime& stage : orFail(renderer.render(scene, spec, TileUse::drawnAnew)).report.stages) {
    whole += stage.milliseconds;
  }
  return whole;
}

/// A renderer for one device alone.
struct OwnDevice {
  std::string name; ///< cpu, gl
  Renderer renderer;
};

/// A frame that was asked for, and what drew it.
struct OwnFrame {
  Renderer* renderer;
  FrameSpec spec;
};

/// Those that this machine has.
std::vector<OwnDevice> ownDevices() {
  std::vector<OwnDevice> devices;
  for (const auto& [name, choice] : {std::pair{"cpu", DeviceChoice::cpu}, std::pair{"gl", DeviceChoice::gl}}) {
    if (auto made = Renderer::create({.backend = {.device = choice}})) devices.push_back({name, std::move(*made)});
  }
  if (devices.empty()) throw Failure("No device can be opened.\n");
  return devices;
}

/// Medians of whole frames that are not encoded, their tiles drawn anew. The frames take turns, so that what slows the
/// machine for a while slows each of them; the first turn, which compiles, is not counted.
std::vector<double> millisecondsOf(const ScenePtr& scene, const std::vector<OwnFrame>& frames, int repeats) {
  std::vector<std::function<double(int)>> calls;
  for (const OwnFrame& frame : frames) {
    calls.emplace_back([&](int) { return millisecondsOf(*frame.renderer, scene, frame.spec); });
  }
  return mediansInTurns(repeats, calls);
}

nlohmann::json ownRows(std::vector<OwnDevice>& devices, const ScenePtr& scene, const nlohmann::json& spec,
                       const Reference& truth, int repeats) {
  nlohmann::json refused = nlohmann::json::array();
  nlohmann::json rows = nlohmann::json::array();
  std::vector<OwnFrame> drawn;
  for (OwnDevice& device : devices) {
    for (const Way& way : ways()) {
      const FrameSpec asked = specOf(spec, way.shadow);
      auto frame = device.renderer.render(scene, shadowSpec(asked));
      if (!frame) { // shadow volumes serve no masked casters, and are OpenGL's alone
        refused.push_back({{"name", way.name}, {"device", device.name}, {"refused", frame.problems().front().detail}});
        continue;
      }
      rows.push_back(rowOf(way.name, truth, std::get<std::vector<float>>(frame->images.front().image.pixels)));
      rows.back()["device"] = device.name;
      rows.back()["texels"] = texelsOf(frame->report);
      drawn.push_back({&device.renderer, asked});
    }
  }
  const std::vector<double> milliseconds = millisecondsOf(scene, drawn, repeats);
  for (std::size_t i = 0; i < drawn.size(); ++i) rows[i]["milliseconds"] = milliseconds[i];
  rows.insert(rows.end(), refused.begin(), refused.end());
  return rows;
}

int run(const std::string& sceneFile, const std::string& specFile, const std::vector<std::string>& pictures,
        int repeats) {
  const nlohmann::json spec = nlohmann::json::parse(testing::readFile(specFile));
  const ScenePtr scene = orFail(loadScene({testing::readFile(sceneFile), {}}));
  Truth truth = truthOf(scene, specOf(spec, nlohmann::json::object()));
  const std::uint64_t receivers = receiversOf(truth.reference);

  std::vector<std::pair<std::string, OtherPicture>> others;
  Alignment worst;
  for (const std::string& each : pictures) {
    const std::size_t split = each.find('=');
    if (split == std::string::npos) throw Failure(each + " is no NAME=FILE.\n");
    auto picture = readOtherPicture(each.substr(split + 1), truth.reference.surface.size());
    if (!picture) throw Failure(each + ": there is no picture of that size.\n");
    const Alignment alignment = alignmentOf(truth.reference, truth.frame.view, truth.anchor, picture->depth);
    leaveOut(truth.reference, alignment);
    worst.coverage = std::max(worst.coverage, alignment.coverage);
    worst.surface = std::max(worst.surface, alignment.surface);
    worst.offset = std::max(worst.offset, alignment.offset);
    others.emplace_back(each.substr(0, split), std::move(*picture));
  }

  std::vector<OwnDevice> devices = ownDevices();
  nlohmann::json out = {{"width", truth.reference.width},
                        {"height", truth.reference.height},
                        {"coverageDiffers", worst.coverage},
                        {"surfaceDiffers", worst.surface},
                        {"surfaceOffset", worst.offset},
                        {"receivers", receiversOf(truth.reference)},
                        {"receiversLeftOut", receivers - receiversOf(truth.reference)}};
  for (const OwnDevice& device : devices) out["devices"][device.name] = device.renderer.info().renderer;
  for (const auto& [name, picture] : others) out["others"].push_back(rowOf(name, truth.reference, picture.shown));
  out["own"] = ownRows(devices, scene, spec, truth.reference, repeats);
  std::cout << out.dump(1) << '\n';
  return 0;
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  CLI::App app{"Errors of shadows that other renderers drew, and of Gnomon's own, as JSON."};
  std::string scene;
  std::string spec;
  std::vector<std::string> pictures;
  int repeats = 5;
  app.add_option("--scene", scene, "A GLB")->required();
  app.add_option("--spec", spec, "A request with one light; `shadow` and `antialiasing` are set here")->required();
  app.add_option("--picture", pictures, "NAME=FILE, little-endian floats: S and view depth of each pixel");
  app.add_option("--repeats", repeats, "Timed frames of each technique")->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);
  try {
    return gnomon::bench::run(scene, spec, pictures, repeats);
  } catch (const gnomon::bench::Failure& failure) {
    std::cerr << failure.what();
    return 1;
  }
}
