#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/light.h"
#include "protocol/spec/shadow_rows.h"

/// The rows of a light; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<Sun> =
    rows("Sun", "A direction given by the sun's place in the sky.",
         field("azimuthDegrees", &Sun::azimuthDegrees,
               {.says = "Where the sun stands, clockwise from north (-Z) as seen from above; east (+X) is 90.",
                .unit = "degrees",
                .range = kAzimuthRange}),
         field("elevationDegrees", &Sun::elevationDegrees,
               {.says = "Height of the sun above the horizon; negative = below it.",
                .unit = "degrees",
                .range = kElevationRange}));
static_assert(kRowsAreComplete<Sun>);

template <>
inline constexpr auto kRows<Light> =
    rows("Light", "A light; a directional one needs `direction` or `sun`.",
         field("type", &Light::type, {.says = "Where the light comes from."}),
         field("direction", &Light::direction,
               {.says = "Direction in which the light travels, of any length but zero; directional and spot lights.",
                .range = kPositionRange}),
         field("sun", &Light::sun,
               {.says = "The sun's place in the sky, instead of `direction`; directional lights only."}),
         field("position", &Light::position,
               {.says = "Where the light stands; required for spot and point lights, refused for directional ones.",
                .unit = "metres",
                .range = kPositionRange}),
         field("range", &Light::range,
               {.says = "Distance beyond which the light has no effect; spot and point lights; absent = no limit. A "
                        "short range lets more lights be culled.",
                .unit = "metres",
                .range = kLengthRange}),
         field("innerConeDegrees", &Light::innerConeDegrees,
               {.says =
                    "Half angle of the cone within which a spot has its full intensity, less than `outerConeDegrees`.",
                .unit = "degrees",
                .range = {0, 90, false, true}}),
         field("outerConeDegrees", &Light::outerConeDegrees,
               {.says = "Half angle of the cone beyond which a spot gives no light. Up to 60 a spot takes one shadow "
                        "tile, beyond it up to five.",
                .unit = "degrees",
                .range = {0, 90, true, true}}),
         field("angularDiameterDegrees", &Light::angularDiameterDegrees,
               {.says = "Angle that the light's disc spans in the sky, 0.53 for the real sun; directional lights only; "
                        "absent = 0. Only technique rayTraced and the exact reference draw a soft shadow for it; the "
                        "other techniques draw a sharp one.",
                .unit = "degrees",
                .range = {0, 90}}),
         field("radius", &Light::radius,
               {.says = "Radius of the glowing ball; spot and point lights; absent = 0. Only technique rayTraced and "
                        "the exact reference draw a soft shadow for it; the other techniques draw a sharp one.",
                .unit = "metres",
                .range = {0, 1e6}}),
         field("color", &Light::color,
               {.says = "Linear red, green and blue; absent = white, or the color of `temperatureKelvin`.",
                .range = kUnitRange}),
         field("temperatureKelvin", &Light::temperatureKelvin,
               {.says = "Color of a glowing black body of this temperature, instead of `color`; 6500 is daylight.",
                .unit = "kelvin",
                .range = kTemperatureRange}),
         field("intensity", &Light::intensity,
               {.says = "Brightness: lux for directional lights, candela for spot and point lights.",
                .unit = "lux or candela",
                .range = kIntensityRange}),
         field("cullingMask", &Light::cullingMask,
               {.says =
                    "Bit mask of layers: the light reaches only nodes of these layers, and only they cast its shadow.",
                .range = {0, double(kAllLayers)}}),
         field("shadow", &Light::shadow,
               {.says = "The light's own shadow options, replacing the frame's `shadow` as a whole; absent = the "
                        "frame's `shadow`."}))
        .withAlternatives({"direction", "sun"}, {"color", "temperatureKelvin"});
static_assert(kRowsAreComplete<Light>);

} // namespace gnomon
