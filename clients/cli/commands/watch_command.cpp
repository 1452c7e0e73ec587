#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/file_watch.h"
#include "clients/cli/files/output_names.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/render/frame_maker.h"
#include "clients/cli/spec/spec_arguments.h"
#include "clients/cli/terminal/messages.h"
#include "clients/cli/terminal/result_text.h"
#include "protocol/base/elapsed.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

struct WatchOptions {
  SceneFileOptions reading;
  std::string scene, output;
  std::string spec; // a file, empty = none
  SpecArguments arguments;
  WhereOptions where;
};

/// The files that the picture is made from, as far as they can be known now.
std::vector<std::filesystem::path> sourcesOf(const WatchOptions& options, const std::vector<RequestFile>& asked) {
  const std::filesystem::path scene(options.scene);
  std::vector<std::filesystem::path> files{scene};
  if (!options.spec.empty()) files.emplace_back(options.spec);
  const auto model = readFile(scene, kLimits.maxSceneBytes);
  if (!model) return files;
  for (const std::string& uri : externalUris(*model)) {
    const auto named = fileUri(uri);
    // What leads out of the scene's folder is refused later, and not looked at here.
    if (named && (!named->isOutside || options.reading.allowOutsideFiles)) {
      files.push_back(scene.parent_path() / named->path);
    }
  }
  for (auto& place : placesOf(asked, scene.parent_path())) files.push_back(std::move(place));
  return files;
}

/// Makes the picture once. The sources are watched before they are read, so that no change is missed.
Status makeOnce(const WatchOptions& options, const ResolvedSpec& resolved, FrameMaker& maker, FileWatch& watch,
                ProgressLine& progress) {
  std::vector<RequestFile> asked;
  if (resolved.spec) asked = requestFiles(*resolved.spec, options.arguments.environment);
  if (Status watched = watch.watch(sourcesOf(options, asked)); !watched) return watched;
  if (!resolved.spec) return resolved.spec.problems();
  progress.stage("reading " + options.scene);
  auto bundle = readSceneFile(options.scene, options.reading, asked);
  if (!bundle) return bundle.problems();
  if (Status opened = maker.open(*std::move(bundle), progress); !opened) return opened;
  const auto rendered = maker.draw(*resolved.spec, progress);
  if (!rendered) return rendered.problems();
  progress.finish();
  printWarnings(warningsOf(rendered->reportJson));
  progress.stage("writing");
  const auto names = writePictures(rendered->pictures, options.output);
  if (!names) return names.problems();
  return Done{};
}

int runWatch(WatchOptions options) {
  options.arguments.format = formatOf(options.output);
  auto watch = FileWatch::create(); // before the renderer starts threads: they are to leave the signals alone, too
  if (!watch) return printProblems(watch.problems());
  if (Status watched = watch->watch(sourcesOf(options, {})); !watched) return printProblems(watched.problems());
  auto maker = makerFor(options.where);
  if (!maker) return printProblems(maker.problems());
  do {
    auto progress = ProgressLine::onTerminal();
    const auto start = std::chrono::steady_clock::now();
    const ResolvedSpec resolved = resolveSpecFile(options.spec, options.arguments);
    const Status made = makeOnce(options, resolved, *maker, *watch, progress);
    progress.finish();
    if (made) {
      std::cout << options.output << "  " << std::lround(millisecondsSince(start)) << " ms" << std::endl;
    } else {
      printProblems(ofScene(options.scene, made.problems()), resolved.origins);
      std::cerr << std::flush;
    }
  } while (watch->wait());
  return kExitOk;
}

} // namespace

Subcommand addWatchCommand(CLI::App& app) {
  auto options = std::make_shared<WatchOptions>();
  auto* command = app.add_subcommand("watch", "Render again when the scene, its files or the request change");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required()->check(CLI::ExistingFile);
  addSceneFileFlags(*command, options->reading);
  command->add_option("-o,--output", options->output, "The picture")->required()->check(checkPictureName);
  command->add_option("--spec", options->spec, "A request as JSON. Flags override its fields")
      ->check(CLI::ExistingFile);
  addPictureFlags(*command, options->arguments);
  addWhereFlags(*command, options->where, options->arguments);
  return {[command] { return command->parsed(); }, [options] { return runWatch(*options); }};
}

} // namespace gnomon::cli
