#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/output_names.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/render/frame_maker.h"
#include "clients/cli/spec/spec_arguments.h"
#include "clients/cli/terminal/messages.h"
#include "clients/cli/terminal/result_text.h"
#include "protocol/base/text.h"
#include "protocol/job/job.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/sequence.h"

/// Many frames of one scene: a request's, or a turn around it.
namespace gnomon::cli {
namespace {

constexpr const char* kVideoSuffix = ".webm";

struct SequenceOptions {
  std::string scene;
  SceneFileOptions reading;
  std::string spec;   ///< a file, "-" = standard input, empty = none; of a sequence a SequenceRequest
  int frames = 36;    ///< of a turntable
  std::string output; ///< with {frame}, or a video
  std::optional<double> framesPerSecond;
  std::optional<int> videoQuality;
  bool isAsync = false;
  std::string report; ///< a file, "-" = standard output, empty = none
  SpecArguments arguments;
  WhereOptions where;
};

bool isVideo(const std::string& output) {
  return std::filesystem::path(output).extension() == kVideoSuffix;
}

/// A suffix that promises moving pictures in one file.
bool looksLikeVideo(const std::string& output) {
  constexpr std::array<std::string_view, 9> kSuffixes{".mp4", ".m4v",  ".mov", ".avi", ".mkv",
                                                      ".ogv", ".mpeg", ".gif", ".apng"};
  const std::string suffix = lowerCase(std::filesystem::path(output).extension().string());
  return suffix == kVideoSuffix || std::find(kSuffixes.begin(), kSuffixes.end(), suffix) != kSuffixes.end();
}

std::string checkFrameName(const std::string& output) {
  if (isVideo(output)) {
    const bool isOne = output.find("{frame}") == std::string::npos && output.find("{view}") == std::string::npos;
    return isOne ? "" : "is one file: a video has no {frame} and no {view} in its name";
  }
  if (looksLikeVideo(output)) {
    return "can't be " + std::filesystem::path(output).extension().string() + ": videos are .webm, as turn.webm";
  }
  const std::string wrong = checkPictureName(output);
  if (!wrong.empty()) return wrong + ", or of a video in .webm";
  if (output.find("{frame}") == std::string::npos) {
    return "needs {frame} in its name, as frames/{frame}.png; a video is one file, as turn.webm";
  }
  return "";
}

Status writeReport(const SequenceOptions& options, const std::string& report) {
  return options.report.empty() ? Status(Done{}) : writeFile(options.report, asBytes(report));
}

/// The file appears once it is whole.
int drawVideo(const SequenceOptions& options, const std::string& requestJson, const Sequence& sequence,
              const FlagOrigins& origins, FrameMaker& maker, ProgressLine& progress) {
  const auto fail = [&](const Problems& problems) {
    progress.finish();
    return printProblems(ofScene(options.scene, problems), origins);
  };
  const auto name = filledIn(options.output, {{"scene", sceneName(options.scene)}});
  if (!name) return fail(name.problems());
  auto file = NewFile::create(*name);
  if (!file) return fail(file.problems());
  const auto take = [&](std::string_view bytes) { return file->write(asBytes(bytes)); };
  const auto report = maker.drawVideo(sequence, requestJson, take, progress);
  if (!report) return fail(report.problems());
  if (auto finished = file->finish(); !finished) return fail(finished.problems());
  progress.finish();
  printWarnings(warningsOf(*report));
  if (auto done = writeReport(options, *report); !done) return printProblems(done.problems());
  if (options.report != "-") std::cout << sequence.count - sequence.first << " frames\n";
  return kExitOk;
}

/// The pictures of one scene, and the names that they get; or its video.
int drawFrames(const SequenceOptions& options, const std::string& requestJson, const Sequence& sequence,
               const FlagOrigins& origins, FrameMaker& maker, ProgressLine& progress) {
  if (isVideo(options.output)) return drawVideo(options, requestJson, sequence, origins, maker, progress);
  std::size_t written = 0;
  const auto take = [&](int index, const std::vector<Picture>& pictures) -> Status {
    const auto name = filledIn(options.output, {{"frame", frameNumber(index)}, {"scene", sceneName(options.scene)}});
    if (!name) return name.problems();
    const auto names = writePictures(pictures, *name);
    if (!names) return names.problems();
    written += names->size();
    return Done{};
  };
  const auto report = maker.drawAll(sequence, requestJson, take, progress);
  progress.finish();
  if (!report) return printProblems(ofScene(options.scene, report.problems()), origins);
  printWarnings(warningsOf(*report));
  if (auto done = writeReport(options, *report); !done) return printProblems(done.problems());
  if (options.report != "-") std::cout << written << " pictures\n";
  return kExitOk;
}

Status openScene(const SequenceOptions& options, const FrameSpec& spec, FrameMaker& maker, ProgressLine& progress) {
  progress.stage("reading " + options.scene);
  auto bundle = readSceneFile(options.scene, options.reading, requestFiles(spec, options.arguments.environment));
  if (!bundle) return bundle.problems();
  const Status opened = maker.open(*std::move(bundle), progress);
  return opened ? opened : Status(ofScene(options.scene, opened.problems()));
}

/// Leaves the frames to a job of the server, and prints its id.
int submitJob(const SequenceOptions& options, const std::string& requestJson, const Sequence& sequence,
              const FlagOrigins& origins) {
  const auto remote = remoteOf(options.where);
  if (!remote) return printProblems(remote.problems());
  const auto bundle =
      readSceneFile(options.scene, options.reading,
                    requestFiles(frameSpec(sequence, sequence.first, sequence.carried), options.arguments.environment));
  if (!bundle) return printProblems(bundle.problems());
  auto progress = ProgressLine::onTerminal();
  std::string id;
  const ScenePost post{"/sequences", requestJson, "asking for a job", {"Prefer", "respond-async"}};
  const auto reply = callAbout(*remote, *bundle, id, post, progress);
  progress.finish();
  if (!reply) return printProblems(ofScene(options.scene, reply.problems()), origins);
  const auto job = reply->status == 202 ? readJob(reply->body) : std::nullopt;
  if (!job) return printProblems(problemsOf(remote->url, *reply), origins);
  std::cout << printable(job->id) << '\n';
  return kExitOk;
}

void addVideoFields(const SequenceOptions& options, Json& request) {
  if (options.framesPerSecond) request["framesPerSecond"] = *options.framesPerSecond;
  if (options.videoQuality) request["videoQuality"] = *options.videoQuality;
}

int runSequence(SequenceOptions options) {
  options.arguments.format = formatOf(options.output);
  const auto text = specText(options.spec);
  if (!text) return printProblems(text.problems());
  Json request = Json::parse(*text, nullptr, false);
  // The decoder reports what is not an object, with its place.
  FlagOrigins origins;
  std::string requestJson = *text;
  if (request.is_object()) {
    const ResolvedSpec resolved = resolveSpec(request.value("spec", Json::object()).dump(), options.arguments);
    if (!resolved.spec) {
      return printProblems(ofRequest(options.spec, about("spec", resolved.spec.problems())), resolved.origins);
    }
    request["spec"] = Json::parse(resolved.json);
    addVideoFields(options, request);
    requestJson = jsonText(request);
    origins = resolved.origins;
  }
  FrameSizes sizes;
  const auto sequence = decodeSequence(requestJson, [&](const FrameSpec& spec) { sizes.see(spec); });
  if (!sequence) return printProblems(ofRequest(options.spec, sequence.problems()));
  if (options.isAsync) return submitJob(options, requestJson, *sequence, origins);
  if (auto problem = sizes.problem(*sequence); problem && isVideo(options.output)) return printProblems({*problem});
  auto maker = makerFor(options.where);
  if (!maker) return printProblems(maker.problems());
  auto progress = ProgressLine::onTerminal();
  if (auto opened = openScene(options, frameSpec(*sequence, sequence->first, sequence->carried), *maker, progress);
      !opened) {
    progress.finish();
    return printProblems(opened.problems());
  }
  return drawFrames(options, requestJson, *sequence, origins, *maker, progress);
}

/// Position and target of a frame's effective camera.
struct Seen {
  Vec3 eye{}, target{};
  double distance() const { return std::hypot(eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]); }
};

Result<Seen> seenBy(FrameMaker& maker, FrameSpec spec, const Orbit& orbit, ProgressLine& progress) {
  // Only the camera matters: small, and without shadows.
  const double scale = std::max(1.0, std::max(spec.width, spec.height) / 64.0);
  spec.width = std::max(1, static_cast<int>(std::lround(spec.width / scale)));
  spec.height = std::max(1, static_cast<int>(std::lround(spec.height / scale)));
  spec.antialiasing = Antialiasing::none;
  spec.shadow.enabled = false;
  spec.quality.reset();
  spec.views = {View::depth};
  spec.output = {};
  spec.camera.orbit = orbit;
  spec.camera.fit.reset();
  const auto rendered = maker.draw(spec, progress);
  if (!rendered) return rendered.problems();
  const Json camera = Json::parse(rendered->reportJson)["spec"]["camera"];
  return Seen{camera["eye"].get<Vec3>(), camera["target"].get<Vec3>()};
}

/// One orbit for all frames: where the spec leaves target or distance open, a distance at which the whole scene shows
/// from all sides, so that it does not grow and shrink while it turns.
Result<Orbit> steadyOrbit(FrameMaker& maker, const FrameSpec& spec, ProgressLine& progress) {
  Orbit orbit = spec.camera.orbit.value_or(Orbit{});
  if (!orbit.target) {
    Orbit any = orbit; // with a distance, the target that is left open is the centre of the scene
    any.distance = 1;
    const auto seen = seenBy(maker, spec, any, progress);
    if (!seen) return seen.problems();
    orbit.target = seen->target;
  }
  if (orbit.distance) return orbit;
  constexpr int kSides = 8;
  double distance = 0;
  for (int side = 0; side < kSides; ++side) {
    Orbit from = orbit;
    from.azimuthDegrees = 360.0 * side / kSides;
    const auto seen = seenBy(maker, spec, from, progress);
    if (!seen) return seen.problems();
    distance = std::max(distance, seen->distance());
  }
  orbit.distance = distance;
  return orbit;
}

Json turn(const Orbit& orbit, int frames) {
  Json patches = Json::array();
  for (int i = 0; i < frames; ++i) {
    const double azimuth = std::remainder(orbit.azimuthDegrees + 360.0 * i / frames, 360.0);
    patches.push_back({{"camera",
                        {{"orbit",
                          {{"azimuthDegrees", azimuth},
                           {"elevationDegrees", orbit.elevationDegrees},
                           {"target", *orbit.target},
                           {"distance", *orbit.distance}}}}}});
  }
  return patches;
}

int runTurntable(SequenceOptions options) {
  options.arguments.format = formatOf(options.output);
  const auto [spec, origins, json] = resolveSpecFile(options.spec, options.arguments);
  if (!spec) return printProblems(spec.problems(), origins);
  const Camera& camera = spec->camera;
  if (camera.lookAt || camera.node || camera.pose) {
    return printProblems({invalidValue("/camera", "A turntable turns around the scene or a target.",
                                       "orbit | fit | no placement", "another placement")},
                         origins);
  }
  auto maker = makerFor(options.where);
  if (!maker) return printProblems(maker.problems());
  auto progress = ProgressLine::onTerminal();
  const auto fail = [&, &places = origins](const Problems& problems) {
    progress.finish();
    return printProblems(problems, places);
  };
  if (auto opened = openScene(options, *spec, *maker, progress); !opened) return fail(opened.problems());
  const auto orbit = steadyOrbit(*maker, *spec, progress);
  if (!orbit) return fail(orbit.problems());
  Json request = {{"spec", Json::parse(json)}, {"frames", turn(*orbit, options.frames)}};
  if (request["spec"].contains("camera")) request["spec"]["camera"].erase("fit");
  addVideoFields(options, request);
  const std::string requestJson = jsonText(request);
  const auto sequence = decodeSequence(requestJson);
  if (!sequence) return fail(sequence.problems());
  return drawFrames(options, requestJson, *sequence, origins, *maker, progress);
}

void addFrameOutput(CLI::App& command, SequenceOptions& options) {
  command
      .add_option("-o,--output", options.output,
                  "The pictures, in a folder that is made if need be; {frame} is replaced by the number of each, "
                  "{scene} by the "
                  "scene's name, {view} for the view's. The suffix is the format: " +
                      suffixList() + "; .webm = one video of the first view")
      ->required()
      ->check(checkFrameName);
  command.add_option("--frames-per-second", options.framesPerSecond, "Frame rate of a video")
      ->check(CLI::Range(1.0, 240.0));
  command
      .add_option("--video-quality", options.videoQuality, "Of a video: 1 = smallest file, 100 = closest to the frames")
      ->check(CLI::Range(1, 100));
  command.add_option("--report", options.report, "Write the sequence's report as JSON; - is standard output");
  addPictureFlags(command, options.arguments);
  addWhereFlags(command, options.where, options.arguments);
}

} // namespace

Subcommand addSequenceCommand(CLI::App& app) {
  auto options = std::make_shared<SequenceOptions>();
  auto* command =
      app.add_subcommand("sequence", "Render the frames of a sequence: paths, moving nodes, a day of the sun");
  command->add_option("scene", options->scene, "A .glb or .gltf file; - is standard input")->required();
  addSceneFileFlags(*command, options->reading);
  addSpecFlag(*command, options->spec,
              ". Here it is a sequence, as POST /v1/scenes/{id}/sequences takes it, and the fields are its spec's");
  addSpecArgument(*command, options->spec);
  addFrameOutput(*command, *options);
  command->get_option("--output")->required(false);
  command
      ->add_flag("--async", options->isAsync,
                 "Draw the frames as a job of the server, and print its id, for gnomon jobs")
      ->needs("--server")
      ->excludes("--output")
      ->excludes("--report");
  command->parse_complete_callback([options] {
    if (options->spec.empty()) throw CLI::RequiredError("--spec");
    if (options->output.empty() && !options->isAsync) throw CLI::RequiredError("--output");
  });
  return {[command] { return command->parsed(); }, [options] { return runSequence(*options); }};
}

Subcommand addTurntableCommand(CLI::App& app) {
  auto options = std::make_shared<SequenceOptions>();
  auto* command = app.add_subcommand("turntable", "Render a scene from all around");
  command->add_option("scene", options->scene, "A .glb or .gltf file; - is standard input")->required();
  addSceneFileFlags(*command, options->reading);
  command->add_option("--frames", options->frames, "Number of pictures in one turn")
      ->check(CLI::Range(2, static_cast<int>(kLimits.maxSequenceFrames)))
      ->capture_default_str();
  addSpecFlag(*command, options->spec);
  addFrameOutput(*command, *options);
  return {[command] { return command->parsed(); }, [options] { return runTurntable(*options); }};
}

} // namespace gnomon::cli
