#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/render/rendering.h"
#include "clients/cli/spec/spec_arguments.h"
#include "clients/cli/terminal/result_text.h"
#include "protocol/evaluation/evaluation.h"
#include "renderer/charts/charts.h"

namespace gnomon::cli {
namespace {

struct EvaluateOptions {
  std::string scene;
  SceneFileOptions reading;
  std::string spec; // a file, "-" = standard input, empty = none
  std::vector<std::string> variants;
  std::optional<std::string> sweep;
  std::optional<std::string> path; // JSON
  std::optional<int> repeats, referenceSamples;
  std::string json, csv, svg; // files, "-" = standard output, empty = none
  SpecArguments arguments;
  WhereOptions where;
};

/// What the server would be sent.
struct Request {
  Result<std::string> json;
  FlagOrigins origins;
};

Request requestOf(const EvaluateOptions& options) {
  const ResolvedSpec spec = resolveSpecFile(options.spec, options.arguments);
  if (!spec.spec) return {spec.spec.problems(), spec.origins};
  FlagOrigins origins{{"/sweep", "--sweep"}, {"/repeats", "--repeats"}, {"/referenceSamples", "--reference-samples"}};
  for (const auto& [pointer, flag] : spec.origins) origins["/spec" + pointer] = flag;
  Json request = {{"spec", Json::parse(spec.json)}};
  Problems problems;
  for (std::size_t i = 0; i < options.variants.size(); ++i) {
    const std::string pointer = "/variants/" + std::to_string(i);
    origins[pointer] = "--variant";
    const auto value = valueOf(options.variants[i]);
    if (value) request["variants"].push_back(*value);
    for (Problem problem : value ? Problems() : value.problems()) {
      problem.pointer.insert(0, pointer);
      problems.push_back(std::move(problem));
    }
  }
  if (options.path) {
    origins["/path"] = "--path";
    const auto value = valueOf(*options.path);
    if (value) request["path"] = *value;
    for (Problem problem : value ? Problems() : value.problems()) {
      problem.pointer.insert(0, "/path");
      problems.push_back(std::move(problem));
    }
  }
  if (!problems.empty()) return {problems, origins};
  if (options.variants.empty()) request["sweep"] = options.sweep.value_or("techniques");
  if (options.repeats) request["repeats"] = *options.repeats;
  if (options.referenceSamples) request["referenceSamples"] = *options.referenceSamples;
  return {request.dump(), origins};
}

Result<EvaluationReport> measure(const EvaluateOptions& options, const std::string& request, ProgressLine& progress) {
  const auto evaluation = decodeEvaluation(request);
  if (!evaluation) return evaluation.problems();
  progress.stage("reading " + options.scene);
  const auto bundle =
      readSceneFile(options.scene, options.reading, requestFiles(evaluation->spec, options.arguments.environment));
  if (!bundle) return bundle.problems();
  if (options.where.server.empty()) return evaluateHere(*bundle, *evaluation, options.where.backend, progress);
  const auto remote = remoteOf(options.where);
  if (!remote) return remote.problems();
  std::string id;
  return evaluateThere(*remote, *bundle, id, request, progress);
}

Status writeText(const std::string& path, const std::string& text) {
  if (path.empty()) return Done{};
  return writeFile(path, asBytes(text));
}

Status writeAll(const EvaluateOptions& options, const EvaluationReport& report) {
  const std::string json = toJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  for (const auto& [path, text] : {std::pair(options.json, json), std::pair(options.csv, evaluationCsv(report)),
                                   std::pair(options.svg, evaluationChart(report))}) {
    if (Status done = writeText(path, text); !done) return done;
  }
  return Done{};
}

int runEvaluate(const EvaluateOptions& options) {
  const auto [request, origins] = requestOf(options);
  if (!request) return printProblems(request.problems(), origins);
  auto progress = ProgressLine::onTerminal();
  const auto report = measure(options, *request, progress);
  progress.finish();
  if (!report) return printProblems(ofScene(options.scene, report.problems()), origins);
  if (const Status written = writeAll(options, *report); !written) return printProblems(written.problems());
  const bool piped = options.json == "-" || options.csv == "-" || options.svg == "-";
  if (!piped) std::cout << evaluationTable(*report);
  const bool any = std::any_of(report->rows.begin(), report->rows.end(),
                               [](const EvaluationRow& row) { return row.metrics.has_value(); });
  return any ? kExitOk : kExitProblem;
}

} // namespace

Subcommand addEvaluateCommand(CLI::App& app) {
  auto options = std::make_shared<EvaluateOptions>();
  auto* command =
      app.add_subcommand("evaluate", "Measure speed and error of shadows, compared with exact ones by ray tracing");
  command->add_option("scene", options->scene, "A .glb or .gltf file")->required();
  addSceneFileFlags(*command, options->reading);
  addSpecFlag(*command, options->spec);
  auto* variants = command->add_option(
      "--variant", options->variants, "One variant: what it changes in the request, as a JSON merge patch. Repeatable");
  variants->type_name("JSON")->take_all()->group("Evaluation");
  command->add_option("--sweep", options->sweep, "A named set of variants; techniques is the default")
      ->type_name("techniques|filters|sizes|all")
      ->excludes(variants)
      ->group("Evaluation");
  command
      ->add_option("--repeats", options->repeats,
                   "Timed frames of each variant, 5 by default. More are steadier and slower")
      ->group("Evaluation");
  command
      ->add_option("--reference-samples", options->referenceSamples,
                   "Rays for each pixel of the reference towards lights that have a size, 256 by default. More are "
                   "less noisy and slower")
      ->group("Evaluation");
  command
      ->add_option("--path", options->path,
                   R"(Measure shimmer along a path of cameras: {"step": [X, Y, Z], "frames": N} or {"cameras": [...]})")
      ->type_name("JSON")
      ->group("Evaluation");
  for (const auto& [flag, file, what] : {std::tuple("--json", &options->json, "The whole report as JSON"),
                                         std::tuple("--csv", &options->csv, "The rows as CSV"),
                                         std::tuple("--svg", &options->svg, "A chart of speed against error")}) {
    command->add_option(flag, *file, std::string(what) + "; - is standard output, instead of the table")
        ->type_name("FILE")
        ->group("Output");
  }
  command->parse_complete_callback([options] {
    if (int(options->json == "-") + int(options->csv == "-") + int(options->svg == "-") > 1) {
      throw CLI::ValidationError("-", "standard output takes one of --json, --csv and --svg");
    }
  });
  addPictureFlags(*command, options->arguments);
  addWhereFlags(*command, options->where, options->arguments);
  return {[command] { return command->parsed(); }, [options] { return runEvaluate(*options); }};
}

} // namespace gnomon::cli
