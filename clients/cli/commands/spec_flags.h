#pragma once

#include <string>
#include <utility>
#include <vector>

#include "clients/cli/files/scene_file.h"
#include "clients/cli/remote/http_client.h"
#include "clients/cli/render/frame_maker.h"
#include "clients/cli/spec/spec_arguments.h"
#include "renderer/render.h"

namespace CLI {
class App;
class Option;
} // namespace CLI

/// The flags that `render`, `plan` and others share. What they fill in outlives the command.
namespace gnomon::cli {

/// Where the work is done.
struct WhereOptions {
  std::string server;  ///< empty = in this process
  std::string keyFile; ///< whose first line is the secret that `server` is shown; empty = GNOMON_KEY
  std::string caFile;  ///< certificates that `server` is held against; empty = the system's
  std::vector<std::pair<std::string, std::string>> headers; ///< sent to `server` with every call
  int patienceSeconds = 600;
  BackendOptions backend;
};

/// --spec: the file of a request. `more`: what there is to say of this command's requests.
void addSpecFlag(CLI::App& command, std::string& file, const std::string& more = "");

/// The same file by its place behind the scene, as it was given before these commands had --spec.
void addSpecArgument(CLI::App& command, std::string& file);

/// The flags of kFieldFlags. `placements`: the other flags that place the camera.
void addFieldFlags(CLI::App& command, SpecArguments& arguments, const std::vector<CLI::Option*>& placements);

/// `cameras`: where --camera may be given several times.
void addPictureFlags(CLI::App& command, SpecArguments& arguments, std::vector<std::string>* cameras = nullptr);

/// --server and how it is called, for commands that can do without one in this process.
void addServerFlags(CLI::App& command, WhereOptions& where);

/// How the model's file is read.
void addSceneFileFlags(CLI::App& command, SceneFileOptions& options);

/// The server, with the key to show it: from the file, or from the environment's GNOMON_KEY. A command line is seen by
/// other users of the machine, so no flag takes a key.
Result<Remote> remoteOf(const WhereOptions& where);

/// What makes frames where the flags say.
Result<FrameMaker> makerFor(const WhereOptions& where);

/// What draws: a device of this process, or a server.
void addWhereFlags(CLI::App& command, WhereOptions& where, SpecArguments& arguments);

} // namespace gnomon::cli
