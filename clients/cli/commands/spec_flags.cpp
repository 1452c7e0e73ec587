#include "clients/cli/commands/spec_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "clients/cli/files/file_io.h"
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

} // namespace

void addPictureFlags(CLI::App& command, SpecArguments& arguments) {
  const auto refuse = [](const char* flag, const char* need) { throw CLI::ValidationError(flag, need); };
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
            const auto sun = parseNumbers(text, 2, 2);
            if (!sun) refuse("--sun", "needs AZIMUTH,ELEVATION in degrees, e.g. 135,40");
            arguments.sun = {(*sun)[0], (*sun)[1]};
          },
          "Place of the sun: degrees clockwise from north (-Z), degrees above the horizon")
      ->type_name("AZ,EL")
      ->group("Picture");
  auto* camera =
      command.add_option("--camera", arguments.camera, "Use a camera of the scene, by its node's name or index")
          ->type_name("NODE")
          ->group("Picture");
  command
      .add_option_function<std::string>(
          "--orbit",
          [&arguments, refuse](const std::string& text) {
            arguments.orbit = parseNumbers(text, 2, 3);
            if (!arguments.orbit)
              refuse("--orbit", "needs AZIMUTH,ELEVATION in degrees and optionally ,DISTANCE in metres");
          },
          "Place the camera around the scene: degrees clockwise from north, degrees above the horizon, and metres; "
          "without a distance, far enough to see all of it")
      ->type_name("AZ,EL[,DIST]")
      ->excludes(camera)
      ->group("Picture");
  command.add_option("--view", arguments.views, "What to show: " + viewNames() + ". Repeatable")
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
          "Set any field of the request by its dotted path. Repeatable")
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

void addWhereFlags(CLI::App& command, WhereOptions& where) {
  auto* device = command.add_option_function<std::string>(
      "--device",
      [&where](const std::string& name) {
        where.backend.device = name == "cpu"  ? DeviceChoice::cpu
                               : name == "gl" ? DeviceChoice::gl
                                              : DeviceChoice::auto_;
      },
      "What draws; auto is OpenGL on a GPU, or else the processor");
  device->check(CLI::IsMember({"auto", "cpu", "gl"}))->type_name("")->default_str("auto")->group("Where");
  auto* backend = command.add_option_function<std::string>(
      "--backend",
      [&where](const std::string& name) {
        where.backend.backend = name == "egl" ? Backend::egl : name == "osmesa" ? Backend::osmesa : Backend::automatic;
      },
      "Graphics context; auto is EGL, then OSMesa");
  backend->check(CLI::IsMember({"auto", "egl", "osmesa"}))->type_name("")->default_str("auto")->group("Where");
  auto* gpu = command.add_flag("--require-gpu", where.backend.requireGpu, "Refuse to run if only software could draw")
                  ->group("Where");
  auto* server = command.add_option("--server", where.server, "Let this server do the work instead of this process")
                     ->type_name("URL")
                     ->excludes(device)
                     ->excludes(backend)
                     ->excludes(gpu)
                     ->group("Where");
  command
      .add_option("--key-file", where.keyFile,
                  "File whose first line is the key that the server asks for; - = standard input. Without it the "
                  "environment's GNOMON_KEY is taken")
      ->type_name("FILE")
      ->needs(server)
      ->group("Where");
}

Result<Remote> remoteOf(const WhereOptions& where) {
  constexpr std::size_t kLargestFile = 4096;
  Remote remote{where.server};
  std::string place = "GNOMON_KEY";
  if (!where.keyFile.empty()) {
    const auto text = readText(where.keyFile, kLargestFile);
    if (!text) return text.problems();
    place = where.keyFile;
    remote.key = trimmed(std::string_view(*text).substr(0, text->find_first_of("\r\n")));
    if (remote.key.empty()) {
      return Problem{ProblemCode::invalidValue, place, "The first line of this file is no key.", "", ""};
    }
  } else if (const char* key = std::getenv("GNOMON_KEY"); key != nullptr) {
    remote.key = key;
  }
  if (std::any_of(remote.key.begin(), remote.key.end(), [](char c) { return c <= ' ' || c >= 0x7f; })) {
    return Problem{ProblemCode::invalidValue, place, "A key has no spaces and none but ASCII characters.", "", ""};
  }
  return remote;
}

} // namespace gnomon::cli
