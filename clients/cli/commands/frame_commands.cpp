#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/render/rendering.h"
#include "clients/cli/spec/spec_arguments.h"
#include "clients/cli/terminal/messages.h"

namespace gnomon::cli {
namespace {

struct RenderOptions {
  std::string scene;
  std::string output;
  std::string spec;   // a file, "-" = standard input, empty = none
  std::string report; // a file, "-" = standard output, empty = none
  SpecArguments arguments;
  WhereOptions where;
};

Result<Rendered> renderScene(const RenderOptions& options, const FrameSpec& spec, ProgressLine& progress) {
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene, spec.volumes);
  if (!bundle) return bundle.problems();
  if (options.where.server.empty()) return renderHere(*bundle, spec, options.where.backend, progress);
  const auto remote = remoteOf(options.where);
  if (!remote) return remote.problems();
  return renderThere(*remote, *bundle, spec, progress);
}

Status writeAll(const RenderOptions& options, const Rendered& rendered, ProgressLine& progress) {
  progress.stage("writing");
  const auto names = writePictures(rendered.pictures, options.output);
  if (!names) return names.problems();
  if (!options.report.empty()) {
    if (auto done = writeFile(options.report, asBytes(rendered.reportJson)); !done) return done;
  }
  progress.finish();
  if (names->size() > 1) {
    for (const std::string& name : *names) std::cout << name << '\n';
  }
  return Done{};
}

int runRender(RenderOptions options) {
  if (options.output != "-") options.arguments.format = formatOf(options.output);
  const auto [spec, origins, json] = resolveSpecFile(options.spec, options.arguments);
  if (!spec) return printProblems(spec.problems(), origins);

  auto progress = ProgressLine::onTerminal();
  const auto rendered = renderScene(options, *spec, progress);
  progress.finish();
  if (!rendered) return printProblems(rendered.problems(), origins);
  const auto written = writeAll(options, *rendered, progress);
  progress.finish();
  if (!written) return printProblems(written.problems());
  return kExitOk;
}

std::string checkOutput(const std::string& output) {
  if (output == "-" || formatOf(output)) return "";
  return "needs a name that ends in one of " + suffixList() + ", or - for standard output";
}

struct PlanOptions {
  std::string scene;
  std::string spec; // a file, "-" = standard input, empty = none
  SpecArguments arguments;
  WhereOptions where;
};

Result<std::string> planScene(const PlanOptions& options, const FrameSpec& spec, ProgressLine& progress) {
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene, spec.volumes);
  if (!bundle) return bundle.problems();
  if (options.where.server.empty()) return planHere(*bundle, spec, options.where.backend, progress);
  const auto remote = remoteOf(options.where);
  if (!remote) return remote.problems();
  return planThere(*remote, *bundle, spec, progress);
}

int runPlan(const PlanOptions& options) {
  const auto [spec, origins, json] = resolveSpecFile(options.spec, options.arguments);
  if (!spec) return printProblems(spec.problems(), origins);
  auto progress = ProgressLine::onTerminal();
  const auto plan = planScene(options, *spec, progress);
  progress.finish();
  if (!plan) return printProblems(plan.problems(), origins);
  std::cout << *plan;
  return kExitOk;
}

} // namespace

Subcommand addRenderCommand(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  auto* command = app.add_subcommand("render", "Render a scene to a picture, in this process or on a server");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  command
      ->add_option(
          "-o,--output", options->output,
          "The picture; its name's suffix is its format: " + suffixList() +
              ". - is standard output. Of several views, each file name gets the view's name, frame.depth.png, but for "
              "EXR and NPZ, which hold every view")
      ->required()
      ->check(checkOutput);
  command->add_option("--spec", options->spec, "A request as JSON; - is standard input. Flags override its fields");
  command->add_option("--report", options->report, "Write the frame's report as JSON; - is standard output");
  addPictureFlags(*command, options->arguments);
  addWhereFlags(*command, options->where);
  return {[command] { return command->parsed(); }, [options] { return runRender(*options); }};
}

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
