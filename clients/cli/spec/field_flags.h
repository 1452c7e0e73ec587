#pragma once

#include <array>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"

namespace gnomon::cli {

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
    FieldFlag{"--exposure", "exposure", FlagValue::number, "STOPS", "", "Light is multiplied by 2 to this power"},
};

/// The value that a flag's text gives its field, of a color all its numbers. A problem says what the text should be.
Result<Json> fieldValue(const FieldFlag& flag, std::string_view text);

/// Puts the flag's value into the spec. Gives the pointer of the field, of a color that of the object.
Result<std::string> applyFieldFlag(Json& spec, const FieldFlag& flag, std::string_view text);

} // namespace gnomon::cli
