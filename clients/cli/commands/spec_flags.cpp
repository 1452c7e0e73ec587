#include "clients/cli/commands/spec_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "clients/cli/files/file_io.h"
#include "clients/cli/files/output_names.h"
#include "clients/cli/spec/spec_arguments.h"
#include "clients/cli/spec/sun_text.h"
#include "protocol/base/text.h"
#include "protocol/fields/field_list.h"
#include "protocol/spec/enum_rows.h"

namespace gnomon::cli {
namespace {

std::string viewNames() {
  std::string names;
  for (const Spelling& view : kSpellings<View>) (names += names.empty() ? "" : ", ") += view.name;
  return names;
}

/// The format that the output's name, or --format, asks for. Whoever asks is an option that was added after those.
std::optional<std::string> askedFormat(const CLI::App& command, const SpecArguments& arguments) {
  const CLI::Option* output = command.get_option_no_throw("--output");
  if (arguments.format || output == nullptr || output->count() == 0) return arguments.format;
  return formatOf(output->results().back());
}

/// "Name: value", as a header of HTTP may be.
std::optional<std::pair<std::string, std::string>> headerOf(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  const auto isToken = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  };
  const auto isText = [](char c) { return (c >= ' ' && c < 0x7f) || c == '\t'; };
  if (!std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(colon), isToken)) return std::nullopt;
  if (!std::all_of(text.begin(), text.end(), isText)) return std::nullopt;
  return std::pair(text.substr(0, colon), std::string(trimmed(std::string_view(text).substr(colon + 1))));
}

} // namespace

void addSpecFlag(CLI::App& command, std::string& file, const std::string& more) {
  command.add_option("--spec", file, "A request as JSON; - is standard input. Flags override its fields" + more)
      ->type_name("FILE");
}

void addSpecArgument(CLI::App& command, std::string& file) {
  command.add_option("request", file, "The same as --spec")->excludes("--spec");
}

void addPictureFlags(CLI::App& command, SpecArguments& arguments, std::vector<std::string>* cameras) {
  const auto refuse = [](const char* flag, const std::string& need) { throw CLI::ValidationError(flag, need); };
  command.add_option("--width", arguments.width, "Width of the picture in pixels")->group("Picture");
  command.add_option("--height", arguments.height, "Height of the picture in pixels")->group("Picture");
  command
      .add_option_function<std::string>(
          "--size",
          [&arguments, refuse](const std::string& text) {
            const auto size = parseSize(text);
            if (!size) refuse("--size", "needs WIDTHxHEIGHT, e.g. 1280x720");
            arguments.width = (*size)[0];
            arguments.height = (*size)[1];
          },
          "Width and height, e.g. 1280x720")
      ->type_name("WxH")
      ->excludes("--width")
      ->excludes("--height")
      ->group("Picture");
  command
      .add_option_function<std::string>(
          "--sun",
          [&arguments, refuse](const std::string& text) {
            arguments.sun = sunOf(text);
            if (arguments.sun) return;
            refuse("--sun",
                   "needs AZIMUTH,ELEVATION in degrees, e.g. 135,40, or 'LATITUDE,LONGITUDE TIME', e.g. "
                   "'48.1,11.6 2026-06-21T17:00+02:00'");
          },
          "Place of the sun: degrees clockwise from north (-Z), degrees above the horizon; or latitude and longitude "
          "in degrees and a time with its zone, as '48.1,11.6 2026-06-21T17:00+02:00'")
      ->type_name("AZ,EL | 'LAT,LON TIME'")
      ->group("Picture");
  command
      .add_option_function<std::string>(
          "--sun-hours",
          [&arguments, refuse](const std::string& text) {
            arguments.sunHours = sunHoursOf(text);
            if (arguments.sunHours) return;
            refuse("--sun-hours",
                   "needs 'LATITUDE,LONGITUDE DATE' or 'LATITUDE,LONGITUDE BEGIN/END', e.g. '48.1,11.6 2026-06-21'");
          },
          "Show for how many hours of a day the sun shines at a place, as '48.1,11.6 2026-06-21': view sunHours. Or "
          "from BEGIN/END, each a date or a time with its zone; a date starts at midnight by the mean sun of the place")
      ->type_name("'LAT,LON DATE[/END]'")
      ->group("Picture");
  command
      .add_option_function<std::string>(
          "--environment",
          [&arguments, refuse](const std::string& text) {
            const std::string wrong = checkEnvironment(text);
            if (!wrong.empty()) refuse("--environment", wrong);
            arguments.environment = text;
          },
          "What lights the scene from all around: an .hdr or .exr file, which goes with the scene; sky, whose sun is "
          "that of --sun; or studio, as without this flag where the glTF has no image-based light")
      ->type_name("FILE|sky|studio")
      ->group("Picture");
  const std::string cameraSays =
      "Use a camera of the scene, by its name, or its index among the scene's cameras, or node:INDEX";
  auto* camera = cameras != nullptr ? command.add_option("--camera", *cameras, cameraSays + ". Repeatable")->take_all()
                                    : command.add_option("--camera", arguments.camera, cameraSays);
  camera->type_name("CAMERA")->group("Picture");
  auto* orbit = command.add_option_function<std::string>(
      "--orbit",
      [&arguments, refuse](const std::string& text) {
        arguments.orbit = parseNumbers(text, 2, 3);
        if (!arguments.orbit)
          refuse("--orbit", "needs AZIMUTH,ELEVATION in degrees and optionally ,DISTANCE in metres");
      },
      "Place the camera around the scene: degrees clockwise from north, degrees above the horizon, and metres; "
      "without a distance, far enough to see all of it");
  orbit->type_name("AZ,EL[,DIST]")->excludes(camera)->group("Picture");
  addFieldFlags(command, arguments, {camera, orbit});
  command.add_option("--view", arguments.views, "What to show: " + viewNames() + ". Repeatable")
      ->type_name("NAME")
      ->take_all()
      ->group("Picture");
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&command, &arguments, refuse](const std::vector<std::string>& texts) {
            arguments.sets.clear(); // `texts` are all that there are, a configuration's first
            for (const std::string& text : texts) {
              const auto equals = text.find('=');
              if (equals == std::string::npos || equals == 0)
                refuse("--set", "needs PATH=VALUE, e.g. shadow.filter.size=7");
              arguments.sets.emplace_back(text.substr(0, equals), text.substr(equals + 1));
            }
            const auto asked = askedFormat(command, arguments), set = formatOfSets(arguments.sets);
            if (asked && set && *asked != *set)
              refuse("--set", "output.format is " + *set + ", but the output's name says " + *asked);
          },
          "Set any field of the request by its path, a list's element as lights[0].intensity. Repeatable")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->group("Picture");
  command
      .add_flag_callback(
          "--fields",
          [] {
            std::cout << fieldHelp();
            throw CLI::Success();
          },
          "List every field of the spec with its meaning, range and default, and exit")
      ->group("Picture");
}

void addSceneFileFlags(CLI::App& command, SceneFileOptions& options) {
  command.add_flag("--strict", options.strict, "Refuse a model that violates glTF, instead of repairing it")
      ->group("Model");
  command
      .add_flag("--allow-outside-files", options.allowOutsideFiles,
                "Open files that the model names outside of its own folder")
      ->group("Model");
}

void addServerFlags(CLI::App& command, WhereOptions& where) {
  auto* server = command.add_option("--server", where.server, "The server that does the work")->envname("GNOMON_URL");
  server->type_name("URL")->group("Server");
  command
      .add_option("--key-file", where.keyFile,
                  "File whose first line is the server's API key; - = standard input. Without it the "
                  "environment's GNOMON_KEY is used")
      ->type_name("FILE")
      ->needs(server)
      ->group("Server");
  command
      .add_option_function<std::vector<std::string>>(
          "--header",
          [&where](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              auto header = headerOf(text);
              if (!header) throw CLI::ValidationError("--header", "needs 'Name: value'");
              where.headers.push_back(*std::move(header));
            }
          },
          "A header of every call, for a proxy before the server. Repeatable")
      ->type_name("'NAME: VALUE'")
      ->take_all()
      ->needs(server)
      ->group("Server");
  command.add_option("--ca-file", where.caFile, "Certificates to trust as PEM, instead of the system's")
      ->type_name("FILE")
      ->check(CLI::ExistingFile)
      ->needs(server)
      ->group("Server");
  command
      .add_option("--patience", where.patienceSeconds, "Longest wait for a server that is busy, starts again or works")
      ->type_name("SECONDS")
      ->check(CLI::Range(1, 86'400))
      ->capture_default_str()
      ->group("Server");
}

void addWhereFlags(CLI::App& command, WhereOptions& where, SpecArguments& arguments) {
  auto* device = command.add_option_function<std::string>(
      "--device",
      [&where, &arguments](const std::string& name) {
        arguments.device = name;
        where.backend.device = name == "cpu"  ? DeviceChoice::cpu
                               : name == "gl" ? DeviceChoice::gl
                                              : DeviceChoice::auto_;
      },
      "What draws; auto is OpenGL on a GPU, or else the processor");
  device->check(CLI::IsMember({"auto", "cpu", "gl"}))->type_name("")->default_str("auto")->group("Where");
  auto* backend = command.add_option_function<std::string>(
      "--backend",
      [&where](const std::string& name) {
        where.backend.backend = name == "egl" ? Backend::egl : name == "osmesa" ? Backend::osmesa : Backend::auto_;
      },
      "Graphics context; auto is EGL, then OSMesa");
  backend->check(CLI::IsMember({"auto", "egl", "osmesa"}))->type_name("")->default_str("auto")->group("Where");
  auto* gpu = command.add_flag("--require-gpu", where.backend.requireGpu, "Refuse to run if only software could draw")
                  ->group("Where");
  addServerFlags(command, where);
  command.get_option("--server")
      ->description("Let this server do the work instead of this process")
      ->envname("")
      ->excludes(backend)
      ->excludes(gpu);
}

Result<Remote> remoteOf(const WhereOptions& where) {
  constexpr std::size_t kLargestKeyFile = 4096;
  Remote remote;
  remote.url = where.server;
  remote.headers = where.headers;
  remote.caFile = where.caFile;
  remote.patience = std::chrono::seconds(where.patienceSeconds);
  std::string place = "GNOMON_KEY";
  if (!where.keyFile.empty()) {
    const auto text = readText(where.keyFile, kLargestKeyFile);
    if (!text) return text.problems();
    place = where.keyFile;
    remote.key = trimmed(std::string_view(*text).substr(0, text->find_first_of("\r\n")));
    if (remote.key.empty()) {
      return invalidValue(place, "The first line of this file is no key.");
    }
  } else if (const char* key = std::getenv("GNOMON_KEY"); key != nullptr) {
    remote.key = key;
  }
  if (std::any_of(remote.key.begin(), remote.key.end(), [](char c) { return c <= ' ' || c >= 0x7f; })) {
    return invalidValue(place, "A key has no spaces and none but ASCII characters.");
  }
  return remote;
}

Result<FrameMaker> makerFor(const WhereOptions& where) {
  if (where.server.empty()) return FrameMaker(where.backend);
  auto remote = remoteOf(where);
  if (!remote) return remote.problems();
  return FrameMaker(*std::move(remote));
}

} // namespace gnomon::cli
