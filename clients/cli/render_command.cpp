#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "clients/cli/commands.h"
#include "clients/cli/file_io.h"
#include "clients/cli/local_render.h"
#include "clients/cli/output_files.h"
#include "clients/cli/problem_text.h"
#include "clients/cli/progress.h"
#include "clients/cli/remote_render.h"
#include "clients/cli/scene_file.h"
#include "clients/cli/spec_arguments.h"

namespace gnomon::cli {
namespace {

struct RenderOptions {
  std::string scene;
  std::string output;
  std::string spec;   // a file, "-" = standard input, empty = none
  std::string report; // a file, "-" = standard output, empty = none
  std::string server; // empty = in this process
  SpecArguments arguments;
  BackendOptions backend;
};

Result<Rendered> renderScene(const RenderOptions& options, const FrameSpec& spec, Progress& progress) {
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene);
  if (!bundle) return bundle.problems();
  if (options.server.empty()) return renderHere(*bundle, spec, options.backend, progress);
  return renderThere(options.server, *bundle, spec, progress);
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
  const auto [spec, origins] = resolveSpec(specJson, options.arguments);
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

void addPictureFlags(CLI::App& command, SpecArguments& arguments) {
  const auto refuse = [](const char* flag, const char* need) { throw CLI::ValidationError(flag, need); };
  command.add_option("--width", arguments.width, "Pixels across")->group("Picture");
  command.add_option("--height", arguments.height, "Pixels down")->group("Picture");
  command
      .add_option_function<std::string>(
          "--size",
          [&arguments, refuse](const std::string& text) {
            const auto size = parseSize(text);
            if (!size) refuse("--size", "needs WIDTHxHEIGHT, e.g. 1280x720");
            arguments.width = (*size)[0];
            arguments.height = (*size)[1];
          },
          "Both at once")
      ->type_name("WxH")
      ->excludes("--width")
      ->excludes("--height")
      ->group("Picture");
  command
      .add_option_function<std::string>(
          "--sun",
          [&arguments, refuse](const std::string& text) {
            const auto sun = parseNumbers(text, 2, 2);
            if (!sun) refuse("--sun", "needs AZIMUTH,ELEVATION in degrees, e.g. 135,40");
            arguments.sun = {(*sun)[0], (*sun)[1]};
          },
          "Put the sun there: degrees clockwise from north (-Z), degrees above the horizon")
      ->type_name("AZ,EL")
      ->group("Picture");
  auto* camera = command.add_option("--camera", arguments.camera, "Look through a camera of the scene")
                     ->type_name("NODE")
                     ->group("Picture");
  command
      .add_option_function<std::string>(
          "--orbit",
          [&arguments, refuse](const std::string& text) {
            arguments.orbit = parseNumbers(text, 2, 3);
            if (!arguments.orbit) refuse("--orbit", "needs AZIMUTH,ELEVATION in degrees and perhaps ,DISTANCE");
          },
          "Look at the scene from there; the distance, in metres, is found when absent")
      ->type_name("AZ,EL[,DIST]")
      ->excludes(camera)
      ->group("Picture");
  command
      .add_option("--view", arguments.views,
                  "What to show: color, depth, normal, cascades, shadow, atlas, tile, texelGrid, texelDensity, "
                  "blendWeight, bias, casterIds, lightContribution. Repeatable")
      ->type_name("NAME")
      ->take_all()
      ->group("Picture");
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&arguments, refuse](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              const auto equals = text.find('=');
              if (equals == std::string::npos || equals == 0)
                refuse("--set", "needs PATH=VALUE, e.g. shadow.filter.size=7");
              arguments.sets.emplace_back(text.substr(0, equals), text.substr(equals + 1));
            }
          },
          "Set any field of the spec by its dotted path. Repeatable")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->group("Picture");
}

} // namespace

Subcommand addRenderCommand(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  auto* command = app.add_subcommand("render", "Render a scene to a picture, here or on a server");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  command
      ->add_option("-o,--output", options->output,
                   "The picture, .png or .exr; - is standard output. Several views as PNG get their names put in: "
                   "frame.depth.png")
      ->required()
      ->check(checkOutput);
  command->add_option("--spec", options->spec, "A frame spec as JSON, - is standard input; the flags go over it");
  command->add_option("--report", options->report, "Write the frame's report as JSON; - is standard output");
  addPictureFlags(*command, options->arguments);
  auto* backend = command->add_option_function<std::string>(
      "--backend",
      [options](const std::string& name) {
        options->backend.backend = name == "egl"      ? Backend::egl
                                   : name == "osmesa" ? Backend::osmesa
                                                      : Backend::automatic;
      },
      "Graphics context; auto is EGL, then OSMesa");
  backend->check(CLI::IsMember({"auto", "egl", "osmesa"}))->type_name("")->default_str("auto")->group("Where");
  auto* gpu =
      command->add_flag("--require-gpu", options->backend.requireGpu, "Refuse to render in software")->group("Where");
  command->add_option("--server", options->server, "Render on this server instead of in this process")
      ->type_name("URL")
      ->excludes(backend)
      ->excludes(gpu)
      ->group("Where");
  return {[command] { return command->parsed(); }, [options] { return runRender(*options); }};
}

} // namespace gnomon::cli
