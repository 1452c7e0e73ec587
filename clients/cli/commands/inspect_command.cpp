#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/terminal/messages.h"
#include "clients/cli/terminal/result_text.h"
#include "protocol/json/json_codec.h"
#include "renderer/render.h"

namespace gnomon::cli {
namespace {

struct InspectOptions {
  std::string scene;
  SceneFileOptions reading;
  bool json = false;
};

Result<SceneSummary> inspect(const InspectOptions& options) {
  auto progress = ProgressLine::onTerminal();
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene, options.reading);
  if (!bundle) return bundle.problems();
  progress.stage("loading the scene");
  const auto scene = loadScene(*bundle);
  if (!scene) return scene.problems();
  return summaryOf(**scene);
}

int runInspect(const InspectOptions& options) {
  const auto summary = inspect(options);
  if (!summary) return printProblems(ofScene(options.scene, summary.problems()));
  if (options.json) {
    std::cout << toJson(*summary).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  } else {
    std::cout << summaryText(options.scene, *summary);
  }
  return kExitOk;
}

} // namespace

Subcommand addInspectCommand(CLI::App& app) {
  auto options = std::make_shared<InspectOptions>();
  auto* command =
      app.add_subcommand("inspect", "Print what a scene holds, and what of it is ignored or drawn differently");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  addSceneFileFlags(*command, options->reading);
  command->add_flag("--json", options->json, "Print JSON, as the server's summary, instead of a tree");
  return {[command] { return command->parsed(); }, [options] { return runInspect(*options); }};
}

} // namespace gnomon::cli
