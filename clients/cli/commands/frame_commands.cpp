#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/output_names.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/render/frame_maker.h"
#include "clients/cli/render/reference.h"
#include "clients/cli/render/rendering.h"
#include "clients/cli/spec/spec_arguments.h"
#include "clients/cli/terminal/messages.h"
#include "clients/cli/terminal/result_text.h"
#include "protocol/base/scene_bundle.h"

namespace gnomon::cli {
namespace {

struct RenderOptions {
  SceneFileOptions reading;
  std::vector<std::string> scenes;
  std::vector<std::string> cameras;
  std::string output;
  std::string spec;       // a file, "-" = standard input, empty = none
  std::string report;     // a file, "-" = standard output, empty = none
  bool reference = false; // beside each frame the one with exact shadows, and the error
  SpecArguments arguments;
  WhereOptions where;
};

/// Writes the report, and prints the names of the pictures if there are several.
Status finishItem(const BatchItem& item, const std::string& reportJson, const std::vector<std::string>& names,
                  ProgressLine& progress) {
  if (!item.report.empty()) {
    if (auto done = writeFile(item.report, asBytes(reportJson)); !done) return done;
  }
  progress.finish();
  if (names.size() > 1 && item.report != "-") {
    for (const std::string& name : names) std::cout << name << '\n';
  }
  return Done{};
}

Status writeAll(const BatchItem& item, const Rendered& rendered, ProgressLine& progress) {
  progress.stage("writing");
  const auto names = writePictures(rendered.pictures, item.output);
  if (!names) return names.problems();
  return finishItem(item, rendered.reportJson, *names, progress);
}

/// The same, and the frame with exact shadows beside it, and how wrong the frame's own are.
Status writeWithReference(const BatchItem& item, const Rendered& rendered, FrameMaker& maker, ProgressLine& progress) {
  const auto spec = drawnSpec(rendered.reportJson);
  if (!spec) return spec.problems();
  auto names = writePictures(rendered.pictures, item.output);
  if (!names) return names.problems();
  const auto exact = maker.draw(withExactShadows(*spec), progress);
  if (!exact) return about("reference", exact.problems());
  const auto others = writePictures(exact->pictures, referenceName(item.output));
  if (!others) return others.problems();
  names->insert(names->end(), others->begin(), others->end());
  const auto report = maker.measure(errorRequest(*spec), progress);
  const auto metrics = report ? metricsOf(*report) : Result<ErrorMetrics>(report.problems());
  if (!metrics) return about("error", metrics.problems());
  if (auto done = finishItem(item, withMetrics(rendered.reportJson, *report), *names, progress); !done) return done;
  if (item.report != "-") std::cout << errorText(*metrics) << '\n';
  return Done{};
}

/// Prefix of the problems and warnings of one of several pictures.
std::string nameOf(const BatchItem& item) {
  return item.scene + (item.camera ? ", camera " + *item.camera : "");
}

/// The pictures of one scene. `several`: there are others, so that what is said of one names it.
class SceneRun {
 public:
  SceneRun(FrameMaker& maker, const RenderOptions& options, ProgressLine& progress, bool several)
      : maker_(maker), options_(options), progress_(progress), several_(several) {}

  /// Opens the scene of the item unless it is open already, and makes its pictures.
  Status make(const BatchItem& item, const FrameSpec& spec) {
    if (scene_ != item.scene) {
      scene_ = item.scene;
      opened_ = open(item.scene, spec);
    }
    if (!opened_) return opened_;
    const auto rendered = maker_.draw(spec, progress_);
    if (!rendered) return rendered.problems();
    progress_.finish();
    std::vector<std::string> warnings = warningsOf(rendered->reportJson);
    for (std::string& warning : warnings) warning.insert(0, several_ ? nameOf(item) + ": " : "");
    printWarnings(warnings);
    if (options_.reference) return writeWithReference(item, *rendered, maker_, progress_);
    return writeAll(item, *rendered, progress_);
  }

 private:
  Status open(const std::string& scene, const FrameSpec& spec) {
    if (maker_.isOnServer() && isSceneId(scene)) {
      maker_.openStored(scene);
      return Done{};
    }
    progress_.stage("reading " + scene);
    auto bundle = readSceneFile(scene, options_.reading, requestFiles(spec, options_.arguments.environment));
    if (!bundle) return bundle.problems();
    return maker_.open(*std::move(bundle), progress_);
  }

  FrameMaker& maker_;
  const RenderOptions& options_;
  ProgressLine& progress_;
  bool several_;
  std::optional<std::string> scene_; ///< that was opened last
  Status opened_ = Done{};
};

/// Every picture that can be made, and the problems of the others.
int renderBatch(const std::vector<BatchItem>& items, const std::vector<ResolvedSpec>& specs,
                const RenderOptions& options, FrameMaker& maker) {
  auto progress = ProgressLine::onTerminal();
  SceneRun run(maker, options, progress, items.size() > 1);
  int exit = kExitOk;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items.size() > 1) {
      progress.lead(std::to_string(i + 1) + " of " + std::to_string(items.size()) + ", " + nameOf(items[i]) + ": ");
    }
    const ResolvedSpec& resolved = specs[i % specs.size()];
    const Status made = items[i].collision ? Status(*items[i].collision) : run.make(items[i], *resolved.spec);
    progress.finish();
    if (made) continue;
    const Problems problems = ofScene(items[i].scene, made.problems());
    exit = printProblems(items.size() > 1 ? about(nameOf(items[i]), problems) : problems, resolved.origins);
  }
  return exit;
}

int runRender(RenderOptions options) {
  if (options.output != "-" && !options.arguments.format) options.arguments.format = formatOf(options.output);
  const auto items = batchItems({options.scenes, options.cameras, options.output, options.report});
  if (!items) return printProblems(items.problems());
  // One for each camera: the same for every scene. The request is read once, since it may come from standard input.
  const auto text = specText(options.spec);
  if (!text) return printProblems(text.problems());
  std::vector<ResolvedSpec> specs;
  for (std::size_t i = 0; i < std::max<std::size_t>(options.cameras.size(), 1); ++i) {
    if (!options.cameras.empty()) options.arguments.camera = options.cameras[i];
    specs.push_back(resolveSpec(*text, options.arguments, options.spec));
    if (!specs.back().spec) return printProblems(specs.back().spec.problems(), specs.back().origins);
  }
  auto maker = makerFor(options.where);
  if (!maker) return printProblems(maker.problems());
  return renderBatch(*items, specs, options, *maker);
}

std::string checkOutput(const std::string& output) {
  const std::string wrong = checkPictureName(output);
  return output == "-" || wrong.empty() ? "" : wrong + ", or - for standard output";
}

struct PlanOptions {
  std::string scene;
  SceneFileOptions reading;
  std::string spec; // a file, "-" = standard input, empty = none
  SpecArguments arguments;
  WhereOptions where;
};

Result<std::string> planScene(const PlanOptions& options, const FrameSpec& spec, ProgressLine& progress) {
  progress.stage("reading " + options.scene);
  const auto bundle = readSceneFile(options.scene, options.reading, requestFiles(spec, options.arguments.environment));
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
  if (!plan) return printProblems(ofScene(options.scene, plan.problems()), origins);
  printWarnings(warningsOf(*plan));
  std::cout << *plan;
  return kExitOk;
}

} // namespace

Subcommand addRenderCommand(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  auto* command = app.add_subcommand("render", "Render a scene to a picture, in this process or on a server");
  command
      ->add_option(
          "scenes", options->scenes,
          "A .glb or .gltf file, or several; - is standard input. With --server also the id of a scene that is "
          "there. Each is loaded once, and drawn by each camera")
      ->required();
  addSceneFileFlags(*command, options->reading);
  auto* output =
      command
          ->add_option(
              "-o,--output", options->output,
              "The picture; its name's suffix is its format: " + suffixList() +
                  ". - is standard output. Of several views, each file name gets the view's name, frame.depth.png, but "
                  "for EXR and NPZ, which hold every view. {scene}, {camera} and {view} are replaced by those "
                  "names, {folder} by that of the scene's folder")
          ->required()
          ->check(checkOutput);
  command
      ->add_option_function<std::string>(
          "--format",
          [options, output](const std::string& format) {
            const auto suffix = formatOf(output->as<std::string>());
            if (suffix && *suffix != format)
              throw CLI::ValidationError("--format", "the output's name says " + *suffix);
            options->arguments.format = format;
          },
          "The picture's format, where its name has no suffix: on standard output")
      ->type_name("NAME");
  addSpecFlag(*command, options->spec);
  command->add_option("--report", options->report, "Write the frame's report as JSON; - is standard output");
  auto* reference = command->add_flag(
      "--reference", options->reference,
      "Also draw the frame with exact shadows, as frame.reference.png, and report the frame's error: on standard "
      "output, and as `reference` in the report");
  command->parse_complete_callback([output, reference] {
    if (reference->count() > 0 && output->as<std::string>() == "-") {
      throw CLI::ValidationError("--reference", "makes two pictures, and standard output takes one");
    }
  });
  addPictureFlags(*command, options->arguments, &options->cameras);
  addWhereFlags(*command, options->where, options->arguments);
  return {[command] { return command->parsed(); }, [options] { return runRender(*options); }};
}

Subcommand addPlanCommand(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  auto* command = app.add_subcommand("plan", "Print what a frame's shadows would be, without rendering it");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  addSceneFileFlags(*command, options->reading);
  addSpecFlag(*command, options->spec);
  addSpecArgument(*command, options->spec);
  addPictureFlags(*command, options->arguments);
  addWhereFlags(*command, options->where, options->arguments);
  return {[command] { return command->parsed(); }, [options] { return runPlan(*options); }};
}

} // namespace gnomon::cli
