#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/commands/commands.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/render/remote_render.h"
#include "clients/cli/spec/spec_flags.h"
#include "clients/cli/terminal/problem_text.h"
#include "clients/cli/terminal/progress.h"
#include "protocol/json/json_codec.h"

namespace gnomon::cli {
namespace {

struct PlanOptions {
  std::string scene;
  std::string spec; // a file, "-" = standard input, empty = none
  SpecArguments arguments;
  WhereOptions where;
};

/// The renderer is created only to ask what it can do; it draws nothing.
Result<std::string> planHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                             Progress& progress) {
  progress.stage("loading the scene");
  const auto scene = loadScene(bundle);
  if (!scene) return scene.problems();
  RendererOptions options;
  options.backend = backend;
  const auto renderer = Renderer::create(options);
  if (!renderer) return renderer.problems();
  progress.stage("planning");
  const auto plan = planFrame(**scene, spec, renderer->info());
  if (!plan) return plan.problems();
  return toJson(*plan).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::string> planScene(const PlanOptions& options, const FrameSpec& spec, Progress& progress) {
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene);
  if (!bundle) return bundle.problems();
  if (options.where.server.empty()) return planHere(*bundle, spec, options.where.backend, progress);
  return planThere(options.where.server, *bundle, spec, progress);
}

int runPlan(const PlanOptions& options) {
  std::string specJson = "{}";
  if (!options.spec.empty()) {
    auto text = readText(options.spec, kLimits.maxSpecBytes);
    if (!text) return printProblems(text.problems());
    specJson = std::move(*text);
  }
  const auto [spec, origins, json] = resolveSpec(specJson, options.arguments);
  if (!spec) return printProblems(spec.problems(), origins);
  auto progress = Progress::onTerminal();
  const auto plan = planScene(options, *spec, progress);
  progress.finish();
  if (!plan) return printProblems(plan.problems(), origins);
  std::cout << *plan;
  return kExitOk;
}

} // namespace

Subcommand addPlanCommand(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  auto* command = app.add_subcommand("plan", "Print what a frame's shadows would be, without rendering it");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  command->add_option("spec", options->spec, "A request as JSON; - is standard input. Flags override its fields");
  addPictureFlags(*command, options->arguments);
  addWhereFlags(*command, options->where);
  return {[command] { return command->parsed(); }, [options] { return runPlan(*options); }};
}

} // namespace gnomon::cli
