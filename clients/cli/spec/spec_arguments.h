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

/// Puts `value` at a field's path (protocol/base/json.h), making the objects on the way; of a list the next free place
/// may be named, too. Problems carry the pointer of the step that can't be taken.
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
  std::optional<Sun> sun;                    ///< --sun: azimuth and elevation, or place and time
  std::optional<SunHours> sunHours;          ///< --sun-hours: place, begin and end
  std::optional<std::string> environment;    ///< --environment: a file's path, or a word of kEnvironmentWords
  std::vector<std::string> views;            ///< --view
  std::map<std::string, std::string> fields; ///< of kFieldFlags: the flag, and its text
  std::optional<std::string> device;         ///< --device
  std::optional<std::string> format;         ///< `output.format`: --format, or from the output's suffix
  std::vector<std::pair<std::string, std::string>> sets; ///< --set: path, value
};

/// What --environment takes besides a file: the sky, and the surroundings that there are without either.
inline constexpr std::array<std::string_view, 2> kEnvironmentWords{"sky", "studio"};

/// What is wrong with --environment; empty = nothing.
std::string checkEnvironment(std::string_view text);

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
/// the lens; --environment goes in place of another file or a sky and keeps the rest; --sun turns the sun of the sky,
/// or where there is none the first directional light, or adds one; --sun-hours keeps the steps and north, and adds its
/// view to those that are named. What is wrong with the JSON by itself is reported with the `file` that it was read
/// from.
ResolvedSpec resolveSpec(const std::string& specJson, const SpecArguments& arguments, const std::string& file = "");

/// The text of a spec in a file; "-" is standard input, an empty name is "{}".
Result<std::string> specText(const std::string& file);

/// The same with the spec in a file; "-" is standard input, an empty name is "{}".
ResolvedSpec resolveSpecFile(const std::string& file, const SpecArguments& arguments);

/// "135,40" -> {135, 40}. Nothing unless there are `least` to `most` finite numbers and nothing else.
std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t least, std::size_t most);

/// "1280x720" -> {1280, 720}.
std::optional<std::array<int, 2>> parseSize(std::string_view text);

enum class FlagValue {
  number,
  threeNumbers,
  color,      ///< three numbers, or four with the alpha: the field's `color` and `alpha`
  word,       ///< taken as it is written
  nameOrIndex ///< the field is called index where it is a whole number, and name where it isn't
};

/// A flag that is a field of the request: `--eye 1,2,3` is `--set camera.eye=[1,2,3]`, and what stands in its way in
/// the request goes.
struct FieldFlag {
  const char* flag;
  const char* path; ///< dotted; of a nameOrIndex and a color the object
  FlagValue value;
  const char* typeName; ///< for help
  const char* replaces; ///< fields of `camera` that go, with a space between: other placements, other lenses
  const char* says;
  const char* bare = nullptr; ///< text of the flag without a value, which is then given with an = or not at all
};

inline constexpr const char* kOtherPlacements = "orbit node fit pose";
inline constexpr const char* kOtherLenses = "intrinsics orthographic";

inline constexpr std::array kFieldFlags{
    FieldFlag{"--eye", "camera.eye", FlagValue::threeNumbers, "X,Y,Z", kOtherPlacements, "Position of the camera"},
    FieldFlag{"--target", "camera.target", FlagValue::threeNumbers, "X,Y,Z", kOtherPlacements,
              "The point that the camera looks at"},
    FieldFlag{"--up", "camera.up", FlagValue::threeNumbers, "X,Y,Z", kOtherPlacements,
              "A direction that points upwards in the picture"},
    FieldFlag{"--fov", "camera.perspective.fovYDegrees", FlagValue::number, "DEGREES", kOtherLenses,
              "Full vertical angle of view"},
    FieldFlag{"--animation", "animation", FlagValue::nameOrIndex, "NAME", "", "An animation, by its name or index"},
    FieldFlag{"--time", "animation.timeSeconds", FlagValue::number, "SECONDS", "", "Time within the animation"},
    FieldFlag{"--variant", "materialVariant", FlagValue::word, "NAME", "", "A material variant of the scene"},
    FieldFlag{"--background", "background", FlagValue::color, "R,G,B[,A]", "",
              "Linear red, green and blue behind everything, and how opaque it is, 0..1; 0,0,0,0 is transparent"},
    FieldFlag{"--transparent", "background.alpha", FlagValue::number, "", "",
              "Nothing behind the scene: the background's alpha is 0", "0"},
    FieldFlag{"--exposure", "exposure", FlagValue::number, "STOPS", "", "Light is multiplied by 2 to this power"},
    FieldFlag{"--tone-mapping", "toneMapping", FlagValue::word, "NAME", "", "How light becomes the colors of a screen"},
    FieldFlag{"--rotate-environment", "environment.rotationDegrees", FlagValue::number, "DEGREES", "",
              "Turns the environment about the vertical axis, clockwise as seen from above"},
    FieldFlag{"--environment-background", "environment.background", FlagValue::word, "NAME", "",
              "Whether the environment is seen behind the scene"},
    FieldFlag{"--sky-shadows", "environment.shadows", FlagValue::word, "", "",
              "The scene hides a part of the light that comes from all around it, found by rays", "rays"},
    FieldFlag{"--sky-samples", "environment.samples", FlagValue::number, "RAYS", "",
              "Rays a pixel of --sky-shadows: more have less noise and take longer"},
    FieldFlag{"--ground", "ground.mode", FlagValue::word, "", "",
              "A plane under the scene that takes its shadows and is not seen itself; --ground=surface is seen",
              "catcher"},
};

/// The value that a flag's text gives its field, of a color all its numbers. A problem says what the text should be.
Result<Json> fieldValue(const FieldFlag& flag, std::string_view text);

/// Puts the flag's value into the spec. Gives the pointer of the field, of a color that of the object.
Result<std::string> applyFieldFlag(Json& spec, const FieldFlag& flag, std::string_view text);

} // namespace gnomon::cli
