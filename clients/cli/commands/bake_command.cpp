#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/render/rendering.h"
#include "clients/cli/spec/spec_arguments.h"
#include "protocol/spec/debug_light.h"

namespace gnomon::cli {
namespace {

struct BakeOptions {
  std::string scene;
  SceneFileOptions reading;
  std::string output;
  std::string spec;   // a file, "-" = standard input, empty = none
  std::string report; // a file, "-" = standard output, empty = none
  std::string light;  // an index, "environment", or empty = all
  SpecArguments arguments;
  WhereOptions where;
};

std::optional<BakeFile> kindOf(const std::string& output) {
  if (output.ends_with(".glb")) return BakeFile::glb;
  if (output.ends_with(".exr")) return BakeFile::exr;
  if (output.ends_with(".png")) return BakeFile::png;
  return std::nullopt;
}

std::optional<int> lightOf(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (text == kEnvironmentName) return kEnvironmentLight;
  int index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size() || index < 0) return std::nullopt;
  return index;
}

std::string checkBakedLight(const std::string& text) {
  return lightOf(text) ? "" : "needs the index of a light, or environment";
}

std::string checkBakeOutput(const std::string& output) {
  return kindOf(output) ? "" : "needs a name that ends in .glb, .exr or .png";
}

Result<Baked> bakeScene(const BakeOptions& options, const FrameSpec& spec, ProgressLine& progress) {
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene, options.reading, requestFiles(spec, options.arguments.environment));
  if (!bundle) return bundle.problems();
  const BakeOrder order{spec, *kindOf(options.output), lightOf(options.light)};
  if (options.where.server.empty()) return bakeHere(*bundle, order, options.where.backend, progress);
  const auto remote = remoteOf(options.where);
  if (!remote) return remote.problems();
  return bakeThere(*remote, *bundle, order, progress);
}

int runBake(const BakeOptions& options) {
  const auto [spec, origins, json] = resolveSpecFile(options.spec, options.arguments);
  if (!spec) return printProblems(spec.problems(), origins);
  auto progress = ProgressLine::onTerminal();
  const auto baked = bakeScene(options, *spec, progress);
  progress.finish();
  if (!baked) return printProblems(ofScene(options.scene, baked.problems()), origins);
  if (const Status written = writeFile(options.output, baked->file); !written) return printProblems(written.problems());
  if (options.report.empty()) return kExitOk;
  const Status reported = writeFile(options.report, asBytes(baked->reportJson));
  return reported ? kExitOk : printProblems(reported.problems());
}

} // namespace

Subcommand addBakeCommand(CLI::App& app) {
  auto options = std::make_shared<BakeOptions>();
  auto* command =
      app.add_subcommand("bake", "Bake the shadows of a static scene into a file, in this process or on a server");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  addSceneFileFlags(*command, options->reading);
  command
      ->add_option("-o,--output", options->output,
                   "What was baked: .glb = the scene with the light that arrives as a light map, .exr or .png = the "
                   "share of light alone")
      ->required()
      ->check(checkBakeOutput);
  addSpecFlag(*command, options->spec,
              ". Lights of technique lightMap are baked, and the environment where environment.shadows is rays");
  command->add_option("--light", options->light, "One of the baked lights, by its index, or environment")
      ->check(checkBakedLight);
  command->add_option("--report", options->report, "Write the bake's report as JSON; - is standard output");
  addPictureFlags(*command, options->arguments);
  addWhereFlags(*command, options->where, options->arguments);
  return {[command] { return command->parsed(); }, [options] { return runBake(*options); }};
}

} // namespace gnomon::cli
