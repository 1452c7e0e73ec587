#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/scene_options.h"
#include "protocol/spec/shadow_rows.h"

/// The rows of cameras, lights and the switches of nodes; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<EyeTarget> =
    rows("EyeTarget", "Position of the eye, and the point that it looks at.",
         field<&EyeTarget::eye>("Position of the camera; 0 0 5 if only `target` or `up` is given.",
                                {.unit = "metres", .range = kPositionRange}),
         field<&EyeTarget::target>(
             "The point that the camera looks at, different from `eye`; 0 0 0 if only `eye` or `up` is given.",
             {.unit = "metres", .range = kPositionRange}),
         field<&EyeTarget::up>(
             "A direction that points upwards in the picture, not parallel to the direction of view; absent = 0 1 0.",
             {.range = kPositionRange}));

template <>
inline constexpr auto kRows<Orbit> = rows(
    "Orbit", "A position on a sphere around a target.",
    field<&Orbit::target>("Centre of the sphere, at which the camera looks; absent = the centre of the scene, or "
                          "without `distance` the point that brings what is seen into the middle of the picture.",
                          {.unit = "metres", .range = kPositionRange}),
    field<&Orbit::azimuthDegrees>("Direction from the target to the eye, clockwise from north (-Z) as seen from above. "
                                  "The default looks from the south-southwest, so that two sides of a building show.",
                                  {.unit = "degrees", .range = kAzimuthRange}),
    field<&Orbit::elevationDegrees>("Height of the eye above the target's horizon.",
                                    {.unit = "degrees", .range = kElevationRange}),
    field<&Orbit::distance>(
        "Distance from the eye to the target; absent = as near as shows all that is seen, with a margin.",
        {.unit = "metres", .range = kLengthRange}));

template <>
inline constexpr auto kRows<Perspective> = rows(
    "Perspective", "A lens with perspective.",
    field<&Perspective::fovYDegrees>("Full vertical angle of view.",
                                     {.unit = "degrees", .range = {0, 180, true, true}}),
    field<&Perspective::near>("Nearest depth that is drawn; absent = half a millimetre, less where the scene is small.",
                              {.unit = "metres", .range = kLengthRange}),
    field<&Perspective::far>("Farthest depth that is drawn, more than `near`; absent = no limit.",
                             {.unit = "metres", .range = kLengthRange}));

template <>
inline constexpr auto kRows<Intrinsics> = rows(
    "Intrinsics",
    "A lens with perspective as calibration gives it. The centre of the upper left pixel is 0 0, as in OpenCV: the "
    "middle of the picture is at (width - 1) / 2, (height - 1) / 2.",
    field<&Intrinsics::fx>("Focal length across.", {.unit = "pixels", .range = kFocalRange}),
    field<&Intrinsics::fy>("Focal length downwards.", {.unit = "pixels", .range = kFocalRange}),
    field<&Intrinsics::cx>("Principal point, from the left; absent = the middle.",
                           {.unit = "pixels", .range = kPrincipalRange}),
    field<&Intrinsics::cy>("Principal point, from the top; absent = the middle.",
                           {.unit = "pixels", .range = kPrincipalRange}),
    field<&Intrinsics::near>("Nearest depth that is drawn; absent = half a millimetre, less where the scene is small.",
                             {.unit = "metres", .range = kLengthRange}),
    field<&Intrinsics::far>("Farthest depth that is drawn, more than `near`; absent = no limit.",
                            {.unit = "metres", .range = kLengthRange}));

template <>
inline constexpr auto kRows<CameraPose> =
    rows("CameraPose", "Position and rotation of a camera, as a matrix.",
         field<&CameraPose::worldFromCamera>(
             "The matrix, row by row, that takes points of the camera's space into the world: a rotation without "
             "mirroring or scale, a translation, and 0 0 0 1 as the last row.",
             {.unit = "metres", .range = kPositionRange}),
         field<&CameraPose::axes>("Which way the camera's axes point."));

template <>
inline constexpr auto kRows<Orthographic> =
    rows("Orthographic", "A lens without perspective.",
         field<&Orthographic::height>("Distance from the lower to the upper edge of the picture.",
                                      {.unit = "metres", .range = kLengthRange}),
         field<&Orthographic::near>("Nearest depth that is drawn; negative = behind the eye.",
                                    {.unit = "metres", .range = kPositionRange}),
         field<&Orthographic::far>("Farthest depth that is drawn, more than `near`.",
                                   {.unit = "metres", .range = kPositionRange}));

template <>
inline constexpr auto kRows<Camera> =
    rows("Camera",
         "At most one placement and at most one lens; without a placement, an orbit that shows the whole scene.",
         inlined<&Camera::lookAt>("Placement by `eye`, `target` and `up`."),
         field<&Camera::orbit>("Placement on a sphere around a target."),
         field<&Camera::node>(
             "Placement and lens of a camera in the scene, by its name; where none has this one, by its index among "
             "the scene's cameras, from 0; or by node: and its node's index, as node:4.",
             {.range = kNodeRange, .minCount = 1, .maxCount = 1024}),
         field<&Camera::fit>("True = show the whole scene from the default direction; false is not accepted.",
                             {.onlyTrue = true}),
         field<&Camera::pose>("Placement by a matrix."),
         field<&Camera::perspective>("A lens with perspective; absent = the lens of the camera node, or 45 degrees."),
         field<&Camera::intrinsics>(
             "A lens with perspective by focal lengths and principal point, instead of `perspective`."),
         field<&Camera::orthographic>("A lens without perspective, instead of one with perspective."))
        .withAlternatives({"lookAt", "orbit", "node", "fit", "pose"}, {"perspective", "intrinsics", "orthographic"});

template <>
inline constexpr auto kRows<Sun> = rows(
    "Sun",
    "A direction given by the sun's place in the sky: by azimuth and elevation, or by a place on Earth and a time, "
    "from "
    "which these follow. The effective spec has azimuth and elevation.",
    field<&Sun::azimuthDegrees>(
        "Direction of the sun, clockwise from north (-Z) as seen from above; east (+X) is 90; absent = 135.",
        {.unit = "degrees", .range = kAzimuthRange}),
    field<&Sun::elevationDegrees>("Height of the sun above the horizon; negative = below it; absent = 45.",
                                  {.unit = "degrees", .range = kElevationRange}),
    field<&Sun::latitudeDegrees>("Latitude of the place, north of the equator positive; with `longitudeDegrees` and "
                                 "`time`, instead of azimuth and elevation.",
                                 {.unit = "degrees", .range = {-90, 90}}),
    field<&Sun::longitudeDegrees>("Longitude of the place, east of Greenwich positive.",
                                  {.unit = "degrees", .range = {-180, 180}}),
    field<&Sun::time>("Date and time with a zone, as RFC 3339 has it, in the years 1900 to 2100: "
                      "2026-06-21T17:00:00+02:00, or Z for UTC; seconds may be left out, leap seconds are refused. The "
                      "sun is where it is seen at sea level: refraction by the air raises it. While it is below the "
                      "horizon its light has intensity 0. In quotes where a query or a flag takes JSON.",
                      {.maxCount = 64, .isTime = true}),
    field<&Sun::northDegrees>("Where true north lies in the scene, clockwise from -Z as seen from above; with a place "
                              "and a time; absent = 0.",
                              {.unit = "degrees", .range = kAzimuthRange}));

template <>
inline constexpr auto kRows<SunHours> = rows(
    "SunHours",
    "What the view `sunHours` adds up: each step counts where the sun shines in its middle, from its centre. Of two "
    "days that are 24 hours apart the second begins at the time of day of `begin`.",
    field<&SunHours::latitudeDegrees>("Latitude of the place, north of the equator positive; required.",
                                      {.unit = "degrees", .range = {-90, 90}}),
    field<&SunHours::longitudeDegrees>("Longitude of the place, east of Greenwich positive; required.",
                                       {.unit = "degrees", .range = {-180, 180}}),
    field<&SunHours::northDegrees>(
        "Where true north lies in the scene, clockwise from -Z as seen from above; absent = 0.",
        {.unit = "degrees", .range = kAzimuthRange}),
    field<&SunHours::begin>("Date and time with a zone at which the hours begin, as a sun's `time`; required.",
                            {.maxCount = 64, .isTime = true}),
    field<&SunHours::end>("Date and time with a zone at which they end, later than `begin`; required. At most 10000 "
                          "steps lie between them, day and night.",
                          {.maxCount = 64, .isTime = true}),
    field<&SunHours::stepMinutes>("Length of a step. Rays of a frame grow with the number of steps by day.",
                                  {.unit = "minutes", .range = {0.1, 1440}}),
    field<&SunHours::stepDays>("Each day that is looked at stands for so many, itself and the ones after it: 7 looks "
                               "at one day of each week. More than 1 needs whole days from `begin` to `end`.",
                               {.unit = "days", .range = {1, 366}}));

template <>
inline constexpr auto kRows<Light> =
    rows("Light", "A light; a directional one needs `direction` or `sun`.",
         field<&Light::type>("Where the light comes from."),
         field<&Light::direction>(
             "Direction in which the light travels, of any length but zero; directional and spot lights.",
             {.range = kPositionRange}),
         field<&Light::sun>("The sun's place in the sky, instead of `direction`; directional lights only."),
         field<&Light::position>(
             "Position of the light; required for spot and point lights, refused for directional ones.",
             {.unit = "metres", .range = kPositionRange}),
         field<&Light::range>("Distance beyond which the light has no effect; spot and point lights; absent = no "
                              "limit. A short range lets more lights be culled.",
                              {.unit = "metres", .range = kLengthRange}),
         field<&Light::innerConeDegrees>(
             "Half angle of the cone within which a spot has its full intensity, less than `outerConeDegrees`.",
             {.unit = "degrees", .range = {0, 90, false, true}}),
         field<&Light::outerConeDegrees>("Half angle of the cone beyond which a spot gives no light. Up to 60 a spot "
                                         "takes one shadow tile, beyond it up to five.",
                                         {.unit = "degrees", .range = {0, 90, true, true}}),
         field<&Light::angularDiameterDegrees>(
             "Angle that the light's disc spans in the sky, 0.53 for the real sun; directional lights only; absent = "
             "0. Techniques rayTraced and lightMap, filter pcss and the exact reference draw a soft shadow for it; all "
             "other techniques ignore it and draw a hard edge.",
             {.unit = "degrees", .range = {0, 90}}),
         field<&Light::radius>("Radius of the glowing ball; spot and point lights; absent = 0. Techniques rayTraced "
                               "and lightMap, filter pcss and the exact reference draw a soft shadow for it; all other "
                               "techniques ignore it and draw a hard edge.",
                               {.unit = "metres", .range = {0, 1e6}}),
         field<&Light::color>("Linear red, green and blue; absent = white, or the color of `temperatureKelvin`.",
                              {.range = kUnitRange}),
         field<&Light::temperatureKelvin>(
             "Color of a glowing black body of this temperature, instead of `color`; 6500 is daylight.",
             {.unit = "kelvin", .range = kTemperatureRange}),
         field<&Light::intensity>("Brightness: lux for directional lights, candela for spot and point lights.",
                                  {.unit = "lux or candela", .range = kIntensityRange}),
         field<&Light::cullingMask>(
             "Bit mask of layers: the light reaches only nodes of these layers, and only they cast its shadow.",
             {.range = {0, double(kAllLayers)}}),
         field<&Light::shadow>("The light's own shadow options, replacing the frame's `shadow` as a whole; absent = "
                               "the frame's `shadow`."))
        .withAlternatives({"direction", "sun"}, {"color", "temperatureKelvin"});

template <>
inline constexpr auto kRows<NodeOptions> =
    rows("NodeOptions",
         "Switches of a node and everything below it, where an entry for a node further down takes precedence; and the "
         "place of the node itself, which what is below it follows.",
         field<&NodeOptions::node>("The node's index, or its name (all nodes of that name); required.",
                                   {.range = kNodeRange, .minCount = 1, .maxCount = 1024}),
         field<&NodeOptions::visible>("False = the camera does not see it; absent = true."),
         field<&NodeOptions::castShadow>("Whether it casts shadows, visible or not; absent = the value of `visible`."),
         field<&NodeOptions::receiveShadow>("False = no shadow falls on it; absent = true."),
         field<&NodeOptions::layers>(
             "Bit mask of its layers, matched with the lights' `cullingMask`; absent = 1, the first layer.",
             {.range = {1, double(kAllLayers)}}),
         field<&NodeOptions::matrix>("Its transform in the space of its parent, instead of that of the file or an "
                                     "animation: an affine matrix, column by column, as in glTF.",
                                     {.range = kPositionRange}),
         field<&NodeOptions::translation>("Its place in the space of its parent; absent = as the file or the animation "
                                          "has it, 0 0 0 for a node with a matrix there.",
                                          {.unit = "metres", .range = kPositionRange}),
         field<&NodeOptions::rotation>("Its rotation, a quaternion x y z w of any length but zero; absent = as the "
                                       "file or the animation has it, none for a node with a matrix there.",
                                       {.range = kPositionRange}),
         field<&NodeOptions::scale>("Its scale along its own axes; absent = as the file or the animation has it, 1 1 1 "
                                    "for a node with a matrix there.",
                                    {.range = kPositionRange}));

} // namespace gnomon
