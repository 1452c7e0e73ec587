#include "tests/bench/device_costs.h"

#include <memory>
#include <stdexcept>

#include "protocol/json/json_codec.h"
#include "tests/bench/depth_floor.h"
#include "tests/bench/gnomon_process.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

using nlohmann::json;

json specOf(const BenchScene& scene, const Setting& setting, int frame) {
  json spec = {{"width", 1280}, {"height", 720}};
  spec.update(scene.path[static_cast<std::size_t>(frame) % scene.path.size()]);
  spec.merge_patch(setting.patch);
  return spec;
}

/// A server, a connection to it, and the scene there.
struct Served {
  std::unique_ptr<Server> server;
  std::unique_ptr<Connection> connection;
  std::string scene;
};

std::vector<Served> serve(const DeviceRun& run, const Bytes& glb) {
  std::vector<Served> all;
  for (const std::string& device : run.devices) {
    Served served;
    served.server = std::make_unique<Server>(Program{run.program, device});
    served.connection = std::make_unique<Connection>(served.server->origin());
    served.scene = served.connection->upload(glb);
    all.push_back(std::move(served));
  }
  return all;
}

/// Nothing where OpenGL is not measured.
std::unique_ptr<DepthFloor> floorOf(const DeviceRun& run, const Bytes& glb, const json& spec, int samples) {
  if (std::find(run.devices.begin(), run.devices.end(), "gl") == run.devices.end()) return nullptr;
  const auto scene = loadScene({glb, {}});
  const auto decoded = decodeFrameSpec(spec.dump());
  if (!scene || !decoded) throw std::runtime_error("the scene or its spec is refused");
  return std::make_unique<DepthFloor>(**scene, *decoded, samples);
}

CostRow warm(const DeviceRun& run, const BenchScene& scene, const Setting& setting, std::vector<Served>& served,
             const Bytes& glb) {
  const auto floor = floorOf(run, glb, specOf(scene, setting, 0), setting.samples);
  std::vector<std::function<double(int)>> calls;
  std::vector<std::vector<double>> processor(served.size());
  for (std::size_t i = 0; i < served.size(); ++i) {
    calls.emplace_back([&, i](int round) {
      const Served& each = served[i];
      const double before = each.server->processorMilliseconds();
      const double time = each.connection->draw(each.scene, specOf(scene, setting, round));
      processor[i].push_back(each.server->processorMilliseconds() - before);
      return time;
    });
  }
  if (floor) calls.emplace_back([&](int) { return floor->draw(); });
  CostRow row{scene.name, setting.name, "ms", mediansInTurns(run.rounds, calls), {}, {}};
  for (const std::vector<double>& times : processor) row.processor.push_back(median(times));
  if (floor) {
    row.floor = row.devices.back();
    row.devices.pop_back();
  }
  return row;
}

CostRow cold(const DeviceRun& run, const BenchScene& scene) {
  const auto folder = std::filesystem::temp_directory_path();
  const std::string picture = (folder / ("gnomon_bench_" + scene.name + ".png")).string();
  const std::string request = (folder / ("gnomon_bench_" + scene.name + ".json")).string();
  writeText(request, specOf(scene, settings().front(), 0).dump());
  std::vector<std::function<double(int)>> calls;
  for (const std::string& device : run.devices) {
    calls.emplace_back([&, device](int) {
      return renderMilliseconds({run.program, device}, {scene.file.string(), "--spec", request, "-o", picture});
    });
  }
  CostRow row{scene.name, "cold, exact", "ms", mediansInTurns(run.rounds / 3 + 1, calls), {}, {}};
  std::filesystem::remove(picture);
  std::filesystem::remove(request);
  return row;
}

} // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = {
      {"exact", {{"antialiasing", "none"}, {"shadow", {{"technique", "rayTraced"}}}}, 1},
      {"shadow map",
       {{"antialiasing", "none"},
        {"shadow", {{"technique", "shadowMap"}, {"cascadeCount", 4}, {"filter", {{"type", "pcf"}, {"size", 5}}}}},
        {"atlas", {{"baseSize", 2048}}}},
       1},
      {"map, 4x", {{"shadow", {{"technique", "shadowMap"}}}}, 4},
      {"defaults", json::object(), 4},
  };
  return all;
}

std::vector<CostRow> costsOf(const DeviceRun& run, const BenchScene& scene) {
  const Bytes glb = testing::readFile(scene.file);
  if (glb.empty()) throw std::runtime_error(scene.file.string() + " can't be read");
  std::vector<CostRow> rows;
  std::vector<Served> served = serve(run, glb);
  for (const Setting& setting : settings()) rows.push_back(warm(run, scene, setting, served, glb));
  CostRow memory{scene.name, "peak memory", "MiB", {}, {}, {}};
  for (const Served& each : served) memory.devices.push_back(each.server->peakBytes() / (1 << 20));
  served.clear();
  rows.push_back(cold(run, scene));
  rows.push_back(std::move(memory));
  return rows;
}

} // namespace gnomon::bench
