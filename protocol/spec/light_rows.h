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
    rows("Sun", "A direction by the sun's place in the sky.",
         field("azimuthDegrees", &Sun::azimuthDegrees,
               {.says = "Where the sun stands, clockwise from north (-Z) seen from above; east (+X) is 90.",
                .unit = "degrees",
                .range = kAzimuthRange}),
         field("elevationDegrees", &Sun::elevationDegrees,
               {.says = "How high the sun stands above the horizon.", .unit = "degrees", .range = kElevationRange}));
static_assert(kRowsAreComplete<Sun>);

template <>
inline constexpr auto kRows<Light> =
    rows("Light", "A light; a directional one needs `direction` or `sun`.",
         field("type", &Light::type, {.says = "Where the light comes from."}),
         field("direction", &Light::direction,
               {.says = "Where the light travels, of any length but zero; directional and spot.",
                .range = kPositionRange}),
         field("sun", &Light::sun, {.says = "The sun's place in the sky, instead of `direction`; directional only."}),
         field("position", &Light::position,
               {.says = "Where the light stands; needed by spot and point, and only theirs.",
                .unit = "metres",
                .range = kPositionRange}),
         field("range", &Light::range,
               {.says = "Distance at which the light ends; spot and point; absent = no end.",
                .unit = "metres",
                .range = kLengthRange}),
         field("innerConeDegrees", &Light::innerConeDegrees,
               {.says = "Half angle within which a spot is at its full intensity, less than the outer.",
                .unit = "degrees",
                .range = {0, 90, false, true}}),
         field("outerConeDegrees", &Light::outerConeDegrees,
               {.says = "Half angle at which a spot ends.", .unit = "degrees", .range = {0, 90, true, true}}),
         field("angularDiameterDegrees", &Light::angularDiameterDegrees,
               {.says = "Angle that the light's disc spans in the sky, 0.53 for the sun; directional only; absent = 0. "
                        "Technique rayTraced softens its shadow by it, and references do; the others draw it sharp.",
                .unit = "degrees",
                .range = {0, 90}}),
         field("radius", &Light::radius,
               {.says = "Radius of the ball that shines; spot and point; absent = 0. Technique rayTraced softens its "
                        "shadow by it, and references do; the others draw it sharp.",
                .unit = "metres",
                .range = {0, 1e6}}),
         field("color", &Light::color,
               {.says = "Linear red, green and blue; absent = white, or by `temperatureKelvin`.", .range = kUnitRange}),
         field("temperatureKelvin", &Light::temperatureKelvin,
               {.says = "Temperature of a black body that glows in the light's color, instead of `color`.",
                .unit = "kelvin",
                .range = kTemperatureRange}),
         field("intensity", &Light::intensity,
               {.says = "Brightness: lux (directional) or candela (spot and point).",
                .unit = "lux or candela",
                .range = kIntensityRange}),
         field("cullingMask", &Light::cullingMask,
               {.says = "Layers, one bit each: the light lights nodes of these layers, and only they cast from it.",
                .range = {0, double(kAllLayers)}}),
         field("shadow", &Light::shadow, {.says = "The light's own shadow, whole; absent = the frame's `shadow`."}))
        .withAlternatives({"direction", "sun"}, {"color", "temperatureKelvin"});
static_assert(kRowsAreComplete<Light>);

} // namespace gnomon
