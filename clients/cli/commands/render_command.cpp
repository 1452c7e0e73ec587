#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/output_files.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/render/local_render.h"
#include "clients/cli/render/remote_render.h"
#include "clients/cli/spec/spec_arguments.h"
#include "clients/cli/spec/spec_flags.h"
#include "clients/cli/terminal/problem_text.h"
#include "clients/cli/terminal/progress.h"

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

Result<Rendered> renderScene(const RenderOptions& options, const FrameSpec& spec, Progress& progress) {
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene);
  if (!bundle) return bundle.problems();
  if (options.where.server.empty()) return renderHere(*bundle, spec, options.where.backend, progress);
  return renderThere(options.where.server, *bundle, spec, progress);
}

Status writeAll(const RenderOptions& options, const Rendered& rendered, Progress& progress) {
  progress.stage("writing");
  const auto names = writePictures(rendered.pictures, options.output);
  if (!names) return names.problems();
  if (!options.report.empty()) {
    const auto* text = reinterpret_cast<const std::uint8_t*>(rendered.reportJson.data());
    if (auto done = writeFile(options.report, {text, rendered.reportJson.size()}); !done) return done;
  }
  progress.finish();
  if (names->size() > 1) {
    for (const std::string& name : *names) std::cout << name << '\n';
  }
  return Done{};
}

int runRender(RenderOptions options) {
  std::string specJson = "{}";
  if (!options.spec.empty()) {
    auto text = readText(options.spec, kLimits.maxSpecBytes);
    if (!text) return printProblems(text.problems());
    specJson = std::move(*text);
  }
  if (options.output != "-") options.arguments.format = formatOf(options.output);
  const auto [spec, origins, json] = resolveSpec(specJson, options.arguments);
  if (!spec) return printProblems(spec.problems(), origins);

  auto progress = Progress::onTerminal();
  const auto rendered = renderScene(options, *spec, progress);
  progress.finish();
  if (!rendered) return printProblems(rendered.problems(), origins);
  const auto written = writeAll(options, *rendered, progress);
  progress.finish();
  if (!written) return printProblems(written.problems());
  return kExitOk;
}

std::string checkOutput(const std::string& output) {
  return output == "-" || formatOf(output) ? "" : "needs a name that ends in .png or .exr, or - for standard output";
}

} // namespace

Subcommand addRenderCommand(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  auto* command = app.add_subcommand("render", "Render a scene to a picture, in this process or on a server");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  command
      ->add_option(
          "-o,--output", options->output,
          "The picture, .png or .exr; - is standard output. With several views as PNG, each file name gets the "
          "view's name: frame.depth.png")
      ->required()
      ->check(checkOutput);
  command->add_option("--spec", options->spec, "A request as JSON; - is standard input. Flags override its fields");
  command->add_option("--report", options->report, "Write the frame's report as JSON; - is standard output");
  addPictureFlags(*command, options->arguments);
  addWhereFlags(*command, options->where);
  return {[command] { return command->parsed(); }, [options] { return runRender(*options); }};
}

} // namespace gnomon::cli
