// How long models take to load, and how much memory at most, against the size of their files. Each load is a process of
// its own, so that none profits from the memory of another. Writes load.md into a folder.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <malloc.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

#include "renderer/image/image_codec.h"
#include "renderer/scene/gltf_loader.h"
#include "tests/bench/tools.h"
#include "tests/support/files.h"
#include "tests/support/gathered_model.h"

namespace gnomon::bench {
namespace {

namespace fs = std::filesystem;

struct Model {
  std::string name;
  SceneBundle bundle;
};

/// What one load took.
struct Load {
  double milliseconds = 0;
  double peakBytes = 0; ///< most memory in use at once, beyond the upload's own bytes
  double keptBytes = 0; ///< of the loaded scene
  double triangles = 0;
};

Model gathered(const fs::path& assets, const nlohmann::json& entry) {
  return {entry.at("id"), testing::gatheredBundle(assets, entry)};
}

/// The gathered models, where there are any, and further GLBs.
std::vector<Model> modelsFrom(const fs::path& assets, const std::vector<std::string>& others) {
  std::vector<Model> models;
  if (std::ifstream file(assets / "manifest.json"); file) {
    const auto manifest = nlohmann::json::parse(file);
    for (const auto& entry : manifest.at("models")) models.push_back(gathered(assets, entry));
  }
  for (const fs::path other : others) models.push_back({other.stem(), {testing::readFile(other), {}}});
  return models;
}

double bytesOf(const SceneBundle& bundle) {
  double bytes = static_cast<double>(bundle.model.size());
  for (const auto& [name, file] : bundle.files) bytes += static_cast<double>(file.size());
  return bytes;
}

/// In this process. Nothing where the model is refused.
std::optional<Load> loaded(const SceneBundle& bundle) {
  malloc_trim(0);                                // what is free already would not be counted again
  std::ofstream("/proc/self/clear_refs") << "5"; // VmHWM starts again, proc(5)
  const double before = statusBytes("self", "VmRSS:");
  const auto begin = std::chrono::steady_clock::now();
  const auto scene = loadGltf(bundle, kLimits);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  if (!scene) return std::nullopt;
  const SceneSummary& summary = (*scene)->summary;
  return Load{time.count(), statusBytes("self", "VmHWM:") - before, static_cast<double>(summary.memoryBytes),
              static_cast<double>(summary.triangles)};
}

/// In a child of this process.
std::optional<Load> loadedApart(const SceneBundle& bundle) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const auto load = loaded(bundle);
    const bool told = load && write(ends[1], &*load, sizeof *load) == static_cast<ssize_t>(sizeof *load);
    _exit(told ? 0 : 1);
  }
  close(ends[1]);
  Load load;
  const bool told = child > 0 && read(ends[0], &load, sizeof load) == static_cast<ssize_t>(sizeof load);
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return told ? std::optional(load) : std::nullopt;
}

double median(std::vector<Load> loads, double Load::*number) {
  const auto middle = loads.begin() + static_cast<std::ptrdiff_t>(loads.size() / 2);
  std::nth_element(loads.begin(), middle, loads.end(),
                   [number](const Load& a, const Load& b) { return a.*number < b.*number; });
  return (*middle).*number;
}

constexpr double kLeastForRatio = 65'536; ///< bytes: in smaller files the program's own pages are most of the peak

/// A row of the table; empty where the model is refused.
std::string rowOf(const Model& model, int rounds) {
  std::vector<Load> loads;
  for (int i = 0; i < rounds; ++i) {
    const auto load = loadedApart(model.bundle);
    if (!load) return {};
    loads.push_back(*load);
  }
  const double mebibyte = 1 << 20;
  const double file = bytesOf(model.bundle);
  const double peak = median(loads, &Load::peakBytes);
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, " | %.1f | %.0f | %.1f | %.1f | %.1f | ", file / 1024, loads[0].triangles,
                median(loads, &Load::milliseconds), peak / mebibyte, loads[0].keptBytes / mebibyte);
  char ratio[32] = "";
  if (file >= kLeastForRatio) std::snprintf(ratio, sizeof ratio, "%.1f ", peak / file);
  return "| " + model.name + numbers + ratio + "|\n";
}

constexpr const char* kHead =
    "# What loading takes\n\n"
    "Made by `bench_load`: medians of %d loads, each in a process of its own. Peak: most memory in use at once beyond "
    "the upload's own bytes; kept: the loaded scene's own count, `memoryBytes`. Images are most of it: a JPEG or PNG "
    "is decoded to 4 bytes a pixel.\n\n"
    "| model | file, KiB | triangles | load, ms | peak, MiB | kept, MiB | peak / file |\n"
    "|---|---|---|---|---|---|---|\n";

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  using namespace gnomon::bench;
  CLI::App app("Load time and peak memory of every model, against file size");
  std::string assets = GNOMON_TEST_ASSETS;
  std::string folder;
  std::vector<std::string> others;
  int rounds = 5;
  app.add_option("--assets", assets, "Folder of the gathered models with their manifest.json; may be absent");
  app.add_option("--rounds", rounds, "Loads of each model")->check(CLI::Range(1, 99));
  app.add_option("--output", folder, "Folder for load.md")->required()->check(CLI::ExistingDirectory);
  app.add_option("others", others, "Further .glb files")->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);

  char head[1024];
  std::snprintf(head, sizeof head, kHead, rounds);
  std::string table = head;
  std::string refused;
  for (const Model& model : modelsFrom(assets, others)) {
    const std::string row = rowOf(model, rounds);
    std::cout << (row.empty() ? model.name + ": refused\n" : row) << std::flush;
    if (row.empty()) refused += (refused.empty() ? "" : ", ") + model.name;
    table += row;
  }
  if (!refused.empty()) table += "\nRefused, for what they require: " + refused + ".\n";
  std::ofstream(std::filesystem::path(folder) / "load.md") << table;
  return 0;
}
