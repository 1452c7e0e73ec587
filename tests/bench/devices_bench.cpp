// What a warm frame, a cold one and a server take on each device, over HTTP on the loopback, PNG included; the devices
// take turns. Writes devices.md and a chart into a folder.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>

#include "renderer/passes/gl_device.h"
#include "tests/bench/device_facts.h"
#include "tests/bench/gnomon_process.h"
#include "tests/bench/svg_plot.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

namespace fs = std::filesystem;

std::string rowText(const DeviceRun& run, const CostRow& row) {
  std::string out = "| " + row.scene + " | " + row.setting + ", " + row.unit;
  for (const double value : row.devices) out += " | " + rounded(value, value < 100 && row.unit == "ms" ? 1 : 0);
  if (run.devices.size() > 1) out += " | **" + rounded(row.devices[1] / row.devices[0], 1) + "**";
  for (std::size_t i = 0; i < run.devices.size(); ++i) {
    out += " | " + (i < row.processor.size() ? rounded(row.processor[i], 0) : "");
  }
  if (run.devices.size() > 1) out += " | " + (row.floor ? rounded(row.devices[0] / *row.floor, 2) : "");
  return out + " |\n";
}

std::string factText(const DeviceFact& fact) {
  std::string out = "| " + fact.what;
  for (const auto& value : fact.devices) out += " | " + (value ? rounded(*value, fact.digits) : "");
  return out + " |\n";
}

std::string headOf(const DeviceRun& run, const std::string& first, const std::string& rest) {
  std::string names, lines = "|---|";
  for (const std::string& device : run.devices) {
    names += " | " + device;
    lines += "---|";
  }
  for (std::size_t i = 1; i < first.size(); ++i) lines += first[i] == '|' ? "---|" : "";
  for (const char letter : rest) lines += letter == '|' ? "---|" : "";
  return "| " + first + names + rest + " |\n" + lines + "\n";
}

/// Warm frames of two settings, a group of bars for each scene.
Plot plotOf(const DeviceRun& run, const std::vector<CostRow>& rows) {
  Plot plot{"A warm frame over HTTP, 1280 x 720, PNG included", "scene", "milliseconds", {}, {}, {}};
  for (const std::string& device : run.devices) {
    for (const char* setting : {"exact", "map, 4x"}) plot.lines.push_back({device + ", " + setting, {}});
  }
  for (const CostRow& row : rows) {
    if (row.setting == "exact") plot.labels.push_back(row.scene);
    for (std::size_t i = 0; i < run.devices.size(); ++i) {
      for (PlotLine& line : plot.lines) {
        if (line.name == run.devices[i] + ", " + row.setting) line.values.emplace_back(row.devices[i]);
      }
    }
  }
  return plot;
}

/// "cpu: NAME (AVX2)" of the devices that can be started; the others leave the run.
std::vector<std::string> startable(DeviceRun& run) {
  std::vector<std::string> names;
  std::erase_if(run.devices, [&](const std::string& device) {
    try {
      const Server server({run.program, device});
      const nlohmann::json info = Connection(server.origin()).get("/v1/capabilities").at("renderer");
      names.push_back("`" + device + "`: " + info.at("renderer").get<std::string>() +
                      (device == "cpu" ? " (" + info.at("version").get<std::string>() + ")" : ""));
      return false;
    } catch (const std::runtime_error& problem) {
      std::cerr << device << " is left out: " << problem.what() << '\n';
      return true;
    }
  });
  return names;
}

std::string load() {
  std::ifstream file("/proc/loadavg");
  std::string minute;
  file >> minute;
  return minute;
}

std::string aboutText(const DeviceRun& run, const std::vector<std::string>& names, const std::string& loadBefore) {
  std::string out = "Medians of " + std::to_string(run.rounds) +
                    " warm frames, 1280 x 720, over HTTP on a kept connection, PNG included; the devices take turns.";
  for (const std::string& name : names) out += " " + name + ".";
  const unsigned cores = std::thread::hardware_concurrency();
  out += " " + std::to_string(cores) + " cores. Load average before " + loadBefore + ", after " + load() +
         ", this run's own included.";
  if (std::stod(loadBefore) > 0.5 * cores) {
    out +=
        " Other work went on: ratios of the devices and processor times say more here than milliseconds, and the "
        "figures of cores and clients say nothing.";
  }
  return out;
}

constexpr const char* kMeanings =
    "`exact`: `rayTraced`, no antialiasing. Where only the camera moves, `cpu` learns from frame to frame which "
    "triangles "
    "see all of the sun: not in demo and city, where it moves. `shadow map`: PCF 5, 4 tiles of 2048 x 2048 texels, no "
    "antialiasing. "
    "`map, 4x`: shadow maps at their defaults, and 4x antialiasing. `defaults`: nothing but camera and sun, so that "
    "auto "
    "chooses the technique. `cold`: `gnomon render` from the start of its process "
    "to its end, files in the page cache. `processor time`: of all "
    "threads of the server together, which other work on the machine changes less. `peak memory`: VmHWM of the server "
    "after its warm frames. Frames differ "
    "from the ones before, so that none of their tiles fits. The floor is a bare depth-only draw of the triangles in "
    "view through OpenGL, "
    "without shading, shadows or PNG, with as many samples.\n\n"
    "To measure again, on a quiet machine:\n\n```sh\nbuild/release/bin/bench_devices --output FOLDER\n"
    "tests/bench/to_readme.py devices FOLDER/devices.md renderer/SPEED.md\n```";

int bench(DeviceRun run, const std::vector<BenchScene>& scenes, const FactScenes& factScenes, bool facts,
          const fs::path& folder) {
  const std::string loadBefore = load();
  const std::vector<std::string> names = startable(run);
  if (run.devices.empty()) return 1;
  // Its context is where the floor is drawn.
  const auto gl = run.devices.back() == "gl" ? createGlDevice({.backend = {}, .tileBytes = 0})
                                             : Result<std::unique_ptr<Device>>(std::unique_ptr<Device>());
  if (!gl) run.devices.pop_back();

  std::vector<CostRow> rows;
  std::string columns = run.devices.size() > 1 ? " | gl / cpu" : "";
  for (const std::string& device : run.devices) columns += " | " + device + ": processor time, ms";
  std::string table = headOf(run, "scene | what", columns + (run.devices.size() > 1 ? " | cpu / floor" : ""));
  for (const BenchScene& scene : scenes) {
    for (CostRow& row : costsOf(run, scene)) {
      table += rowText(run, row);
      std::cerr << rowText(run, row);
      rows.push_back(std::move(row));
    }
  }
  std::string more;
  if (facts) {
    more = headOf(run, "what", "");
    for (const DeviceFact& fact : factsOf(run, factScenes)) more += factText(fact);
    std::cerr << more;
  }
  const std::string text = "# What a frame costs on each device\n\nMade by `bench_devices`.\n\n<!-- readme -->\n\n" +
                           aboutText(run, names, loadBefore) + "\n\n![A warm frame on each device](devices.svg)\n\n" +
                           table + "\n" + more + "\n<!-- /readme -->\n\n" + kMeanings + "\n";
  if (folder.empty()) {
    std::cout << text;
    return 0;
  }
  fs::create_directories(folder);
  std::ofstream(folder / "devices.md") << text;
  std::ofstream(folder / "devices.svg") << svgOf(plotOf(run, rows));
  return 0;
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  using namespace gnomon::bench;
  namespace fs = std::filesystem;
  CLI::App app{"Frames on each device, in turns. Figures mean something only on a quiet machine."};
  const fs::path build = fs::canonical("/proc/self/exe").parent_path().parent_path();
  DeviceRun run{build / "bin/gnomon", {"cpu", "gl"}};
  fs::path folder;
  fs::path described = GNOMON_BENCH_SCENES;
  std::vector<std::string> others;
  std::vector<std::string> only;
  bool noFacts = false;
  app.add_option("--output", folder, "Folder for devices.md and devices.svg; without it the table is printed");
  app.add_option("--rounds", run.rounds, "Frames that count")->check(CLI::Range(1, 1000));
  app.add_option("--devices", run.devices, "cpu, gl or both")->check(CLI::IsMember({"cpu", "gl"}));
  app.add_option("--program", run.program, "gnomon")->check(CLI::ExistingFile);
  app.add_option("--scenes", described, "Folder of scenes, each a .json beside its .glb; may be absent");
  app.add_option("--only", only, "Names of the scenes to take");
  app.add_flag("--scenes-only", noFacts, "Leave out starts, small frames and ratios");
  app.add_option("others", others, "Further .json files that describe scenes")->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);

  try {
    const BenchScene demo = sunPathScene("demo", build / "share/gnomon/demo.glb", "overview", 58, 22);
    const BenchScene city = sunPathScene("city", GNOMON_TEST_SCENES "/city.glb", "camera", 150, 35);
    std::vector<BenchScene> scenes;
    std::error_code absent;
    std::vector<fs::path> descriptions(others.begin(), others.end());
    for (const auto& entry : fs::directory_iterator(described, absent)) {
      if (entry.path().extension() == ".json") descriptions.push_back(entry.path());
    }
    std::sort(descriptions.begin(), descriptions.end());
    for (const fs::path& description : descriptions) scenes.push_back(orbitScene(description));
    const BenchScene busy = scenes.empty() ? city : scenes.front();
    scenes.insert(scenes.end(), {hallScene(build / "tests"), demo, city});
    if (!only.empty()) {
      std::erase_if(scenes, [&](const BenchScene& scene) {
        return std::find(only.begin(), only.end(), scene.name) == only.end();
      });
    }
    return bench(run, scenes, {demo, city, busy}, !noFacts, folder);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  }
}
