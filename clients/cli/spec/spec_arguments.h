#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/cli/terminal/messages.h"
#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon::cli {

/// "lights[0].sun.azimuthDegrees" -> "/lights/0/sun/azimuthDegrees".
std::string pointerOf(std::string_view path);

/// Puts `value` at a field's path (field_path.h), making the objects on the way; of a list the next free place may be
/// named, too. Problems carry the pointer of the step that can't be taken.
Status setAtPath(Json& root, std::string_view path, Json value);

/// As in a query string: JSON where the text begins like JSON or is one of its words, else a bare word: 3, true,
/// [1,2,3], Large. JSON that is broken, too deep or has a key twice is a problem.
Result<Json> valueOf(std::string_view text);

/// What the flags of `render` say about the picture.
struct SpecArguments {
  std::optional<int> width;                  ///< --width, --size
  std::optional<int> height;                 ///< --height, --size
  std::optional<std::string> camera;         ///< --camera: its name, its index, or "node:" and its node's index
  std::optional<std::vector<double>> orbit;  ///< --orbit: azimuth, elevation, distance if a third
  std::optional<std::array<double, 2>> sun;  ///< --sun: azimuth, elevation
  std::vector<std::string> views;            ///< --view
  std::map<std::string, std::string> fields; ///< of kFieldFlags: the flag, and its text
  std::optional<std::string> device;         ///< --device
  std::optional<std::string> format;         ///< `output.format`: --format, or from the output's suffix
  std::vector<std::pair<std::string, std::string>> sets; ///< --set: path, value
};

/// The `output.format` that the last of these --set asks for, by its own path or within `output`; nothing where none
/// does.
std::optional<std::string> formatOfSets(const std::vector<std::pair<std::string, std::string>>& sets);

/// A spec and where its parts came from.
struct ResolvedSpec {
  Result<FrameSpec> spec;
  FlagOrigins origins;
  std::string json; ///< as it was written, the flags laid over it; "{}" where it can't be read
};

/// The problems of a request that was read from a file, each saying so; "-" is standard input, an empty name is none.
Problems ofRequest(const std::string& file, Problems problems);

/// `specJson` (a whole FrameSpec, "{}" for none) with the flags laid over it, in the order above but for the format,
/// which comes last, then checked as the server checks a request. --camera and --orbit replace the placement and keep
/// the lens; --sun turns the first directional light, or adds one. What is wrong with the JSON by
/// itself is reported with the `file` that it was read from.
ResolvedSpec resolveSpec(const std::string& specJson, const SpecArguments& arguments, const std::string& file = "");

/// The text of a spec in a file; "-" is standard input, an empty name is "{}".
Result<std::string> specText(const std::string& file);

/// The same with the spec in a file; "-" is standard input, an empty name is "{}".
ResolvedSpec resolveSpecFile(const std::string& file, const SpecArguments& arguments);

/// "135,40" -> {135, 40}. Nothing unless there are `least` to `most` finite numbers and nothing else.
std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t least, std::size_t most);

/// "1280x720" -> {1280, 720}.
std::optional<std::array<int, 2>> parseSize(std::string_view text);

} // namespace gnomon::cli
