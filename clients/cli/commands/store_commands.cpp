#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/scene_file.h"
#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/base/scene_bundle.h"

/// The scenes that a server keeps.
namespace gnomon::cli {
namespace {

struct StoreOptions {
  SceneFileOptions reading;
  std::vector<std::string> items; ///< files, or ids
  std::string environment;        ///< a file that goes with each; empty = none
  bool json = false;
  WhereOptions where;
};

/// For commands that have no meaning without a server.
void addStoreServerFlags(CLI::App& command, WhereOptions& where) {
  where.server = "http://127.0.0.1:8080";
  addServerFlags(command, where);
  command.get_option("--server")->capture_default_str();
}

/// Does the same for each item: those that can be done are.
template <class Act>
int forEachItem(const StoreOptions& options, Act act) {
  const auto remote = remoteOf(options.where);
  if (!remote) return printProblems(remote.problems());
  auto progress = ProgressLine::onTerminal();
  int exit = kExitOk;
  for (const std::string& item : options.items) {
    const Result<std::string> line = act(*remote, item, progress);
    progress.finish();
    if (line && !line->empty()) std::cout << *line << '\n' << std::flush;
    if (!line) exit = printProblems(line.problems());
  }
  return exit;
}

Result<std::string> uploadFile(const Remote& remote, const std::string& file, const StoreOptions& options,
                               ProgressLine& progress) {
  progress.stage("reading " + file);
  std::vector<RequestFile> more;
  if (!options.environment.empty()) more.push_back(environmentFile(options.environment));
  const auto bundle = readSceneFile(file, options.reading, more);
  if (!bundle) return bundle.problems();
  auto id = sceneId(remote, *bundle, progress);
  if (!id) return about(file, id.problems());
  return *id + "  " + printable(file);
}

Result<std::string> removeScene(const Remote& remote, const std::string& id, ProgressLine& progress) {
  progress.stage("removing " + id);
  if (!isSceneId(id)) return invalidValue("ID", "This is no scene's id.", "64 hexadecimal digits", id);
  HttpCall call;
  call.method = "DELETE";
  call.path = "/v1/scenes/" + id;
  const auto reply = callPatiently(remote, call, progress);
  if (!reply) return reply.problems();
  if (reply->status != 204 && reply->status != 200) return problemsOf(remote.url, *reply);
  return std::string();
}

std::string sceneLine(const Json& scene) {
  const auto number = [&](const char* key) {
    const auto found = scene.find(key);
    return found != scene.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
  };
  return textAt(scene, "id") + "  " + std::to_string(number("bytes")) + " bytes  " +
         std::to_string(number("triangles")) + " triangles";
}

/// The page after this id, of which `print` gets each scene. Gives what the next page comes after; empty = this was the
/// last.
template <class Print>
Result<std::string> listPage(const Remote& remote, const std::string& after, ProgressLine& progress, Print print) {
  HttpCall call;
  call.path = "/v1/scenes" + (after.empty() ? "" : "?after=" + after);
  const auto reply = callPatiently(remote, call, progress);
  progress.finish();
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  const Json page = Json::parse(reply->body, nullptr, false);
  if (!page.is_object() || !page.contains("scenes") || !page["scenes"].is_array()) {
    return Problem{ProblemCode::internal, remote.url, "The reply is not a list of scenes."};
  }
  for (const Json& scene : page["scenes"]) {
    if (scene.is_object()) print(scene);
  }
  const std::string next = textAt(page, "next");
  const bool goesOn = next.empty() || next > after; // ids ascend: a server that turns in circles is left
  if (!goesOn) return Problem{ProblemCode::internal, remote.url, "The pages of the list don't ascend."};
  return next;
}

int runLs(const StoreOptions& options) {
  const auto remote = remoteOf(options.where);
  if (!remote) return printProblems(remote.problems());
  auto progress = ProgressLine::onTerminal();
  const auto print = [&](const Json& scene) {
    std::cout << (options.json ? scene.dump(-1, ' ', false, Json::error_handler_t::replace)
                               : printable(sceneLine(scene)))
              << '\n';
  };
  std::string after;
  do {
    progress.stage("listing");
    auto next = listPage(*remote, after, progress, print);
    if (!next) return printProblems(next.problems());
    after = *std::move(next);
  } while (!after.empty());
  return kExitOk;
}

} // namespace

Subcommand addUploadCommand(CLI::App& app) {
  auto options = std::make_shared<StoreOptions>();
  auto* command = app.add_subcommand("upload", "Give scenes to a server, and print their ids");
  command->add_option("scenes", options->items, "A .glb or .gltf file, or several; - is standard input")->required();
  addSceneFileFlags(*command, options->reading);
  command
      ->add_option("--environment", options->environment,
                   "An .hdr or .exr file that goes with each scene, for frames that name it")
      ->type_name("FILE")
      ->group("Model");
  addStoreServerFlags(*command, options->where);
  return {[command] { return command->parsed(); },
          [options] {
            return forEachItem(*options, [&](const Remote& remote, const std::string& file, ProgressLine& progress) {
              return uploadFile(remote, file, *options, progress);
            });
          }};
}

Subcommand addLsCommand(CLI::App& app) {
  auto options = std::make_shared<StoreOptions>();
  auto* command = app.add_subcommand("ls", "List a server's scenes");
  command->add_flag("--json", options->json, "Print each scene's summary as JSON on a line");
  addStoreServerFlags(*command, options->where);
  return {[command] { return command->parsed(); }, [options] { return runLs(*options); }};
}

Subcommand addRmCommand(CLI::App& app) {
  auto options = std::make_shared<StoreOptions>();
  auto* command = app.add_subcommand("rm", "Remove scenes from a server");
  command->add_option("ids", options->items, "The id of a scene, or several")->required();
  addStoreServerFlags(*command, options->where);
  return {[command] { return command->parsed(); }, [options] { return forEachItem(*options, removeScene); }};
}

} // namespace gnomon::cli
