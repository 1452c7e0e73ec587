#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/scene_options.h"
#include "protocol/spec/shadow_rows.h"

/// The rows of cameras, lights and the switches of nodes; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<EyeTarget> = rows(
    "EyeTarget", "Position of the eye, and the point that it looks at.",
    field("eye", &EyeTarget::eye,
          {.says = "Position of the camera; 0 0 5 if only `target` or `up` is given.",
           .unit = "metres",
           .range = kPositionRange}),
    field("target", &EyeTarget::target,
          {.says = "The point that the camera looks at, different from `eye`; 0 0 0 if only `eye` or `up` is given.",
           .unit = "metres",
           .range = kPositionRange}),
    field("up", &EyeTarget::up,
          {.says =
               "A direction that points upwards in the picture, not parallel to the direction of view; absent = 0 1 0.",
           .range = kPositionRange}));
static_assert(kRowsAreComplete<EyeTarget>);

template <>
inline constexpr auto kRows<Orbit> =
    rows("Orbit", "A position on a sphere around a target.",
         field("target", &Orbit::target,
               {.says = "Centre of the sphere, at which the camera looks; absent = the centre of the scene, or without "
                        "`distance` the point that brings what is seen into the middle of the picture.",
                .unit = "metres",
                .range = kPositionRange}),
         field("azimuthDegrees", &Orbit::azimuthDegrees,
               {.says = "Direction from the target to the eye, clockwise from north (-Z) as seen from above. The "
                        "default looks from the south-southwest, so that two sides of a building show.",
                .unit = "degrees",
                .range = kAzimuthRange}),
         field("elevationDegrees", &Orbit::elevationDegrees,
               {.says = "Height of the eye above the target's horizon.", .unit = "degrees", .range = kElevationRange}),
         field("distance", &Orbit::distance,
               {.says = "Distance from the eye to the target; absent = as near as shows all that is seen, "
                        "with a margin.",
                .unit = "metres",
                .range = kLengthRange}));
static_assert(kRowsAreComplete<Orbit>);

template <>
inline constexpr auto kRows<Perspective> =
    rows("Perspective", "A lens with perspective.",
         field("fovYDegrees", &Perspective::fovYDegrees,
               {.says = "Full vertical angle of view.", .unit = "degrees", .range = {0, 180, true, true}}),
         field("near", &Perspective::near,
               {.says = "Nearest depth that is drawn; absent = half a millimetre, less where the scene is small.",
                .unit = "metres",
                .range = kLengthRange}),
         field("far", &Perspective::far,
               {.says = "Farthest depth that is drawn, more than `near`; absent = no limit.",
                .unit = "metres",
                .range = kLengthRange}));
static_assert(kRowsAreComplete<Perspective>);

template <>
inline constexpr auto kRows<Intrinsics> = rows(
    "Intrinsics",
    "A lens with perspective as calibration gives it. The centre of the upper left pixel is 0 0, as in OpenCV: the "
    "middle of the picture is at (width - 1) / 2, (height - 1) / 2.",
    field("fx", &Intrinsics::fx, {.says = "Focal length across.", .unit = "pixels", .range = kFocalRange}),
    field("fy", &Intrinsics::fy, {.says = "Focal length downwards.", .unit = "pixels", .range = kFocalRange}),
    field("cx", &Intrinsics::cx,
          {.says = "Principal point, from the left; absent = the middle.", .unit = "pixels", .range = kPrincipalRange}),
    field("cy", &Intrinsics::cy,
          {.says = "Principal point, from the top; absent = the middle.", .unit = "pixels", .range = kPrincipalRange}),
    field("near", &Intrinsics::near,
          {.says = "Nearest depth that is drawn; absent = half a millimetre, less where the scene is small.",
           .unit = "metres",
           .range = kLengthRange}),
    field("far", &Intrinsics::far,
          {.says = "Farthest depth that is drawn, more than `near`; absent = no limit.",
           .unit = "metres",
           .range = kLengthRange}));
static_assert(kRowsAreComplete<Intrinsics>);

template <>
inline constexpr auto kRows<CameraPose> =
    rows("CameraPose", "Position and rotation of a camera, as a matrix.",
         field("worldFromCamera", &CameraPose::worldFromCamera,
               {.says = "The matrix, row by row, that takes points of the camera's space into the world: a rotation "
                        "without mirroring or scale, a translation, and 0 0 0 1 as the last row.",
                .unit = "metres",
                .range = kPositionRange}),
         field("axes", &CameraPose::axes, {.says = "Which way the camera's axes point."}));
static_assert(kRowsAreComplete<CameraPose>);

template <>
inline constexpr auto kRows<Orthographic> =
    rows("Orthographic", "A lens without perspective.",
         field("height", &Orthographic::height,
               {.says = "Distance from the lower to the upper edge of the picture.",
                .unit = "metres",
                .range = kLengthRange}),
         field("near", &Orthographic::near,
               {.says = "Nearest depth that is drawn; negative = behind the eye.",
                .unit = "metres",
                .range = kPositionRange}),
         field("far", &Orthographic::far,
               {.says = "Farthest depth that is drawn, more than `near`.", .unit = "metres", .range = kPositionRange}));
static_assert(kRowsAreComplete<Orthographic>);

template <>
inline constexpr auto kRows<Camera> =
    rows("Camera",
         "At most one placement and at most one lens; without a placement, an orbit that shows the whole scene.",
         inlined("lookAt", &Camera::lookAt, {.says = "Placement by `eye`, `target` and `up`."}),
         field("orbit", &Camera::orbit, {.says = "Placement on a sphere around a target."}),
         field("node", &Camera::node,
               {.says = "Placement and lens of a camera in the scene, by its name; where none has this one, by its "
                        "index among the scene's "
                        "cameras, from 0; or by node: and its node's index, as node:4.",
                .range = kNodeRange,
                .minCount = 1,
                .maxCount = 1024}),
         field("fit", &Camera::fit,
               {.says = "True = show the whole scene from the default direction; false is not accepted.",
                .onlyTrue = true}),
         field("pose", &Camera::pose, {.says = "Placement by a matrix."}),
         field("perspective", &Camera::perspective,
               {.says = "A lens with perspective; absent = the lens of the camera node, or 45 degrees."}),
         field("intrinsics", &Camera::intrinsics,
               {.says = "A lens with perspective by focal lengths and principal point, instead of `perspective`."}),
         field("orthographic", &Camera::orthographic,
               {.says = "A lens without perspective, instead of one with perspective."}))
        .withAlternatives({"lookAt", "orbit", "node", "fit", "pose"}, {"perspective", "intrinsics", "orthographic"});
static_assert(kRowsAreComplete<Camera>);

template <>
inline constexpr auto kRows<Sun> =
    rows("Sun", "A direction given by the sun's place in the sky.",
         field("azimuthDegrees", &Sun::azimuthDegrees,
               {.says = "Direction of the sun, clockwise from north (-Z) as seen from above; east (+X) is 90.",
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
               {.says = "Position of the light; required for spot and point lights, refused for directional ones.",
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
                        "absent = 0. Techniques rayTraced and lightMap, filter pcss and the exact reference "
                        "draw a soft shadow for it; all other techniques ignore it and draw a hard edge.",
                .unit = "degrees",
                .range = {0, 90}}),
         field("radius", &Light::radius,
               {.says = "Radius of the glowing ball; spot and point lights; absent = 0. Techniques rayTraced "
                        "and lightMap, filter pcss and the exact reference draw a soft shadow for it; all other "
                        "techniques ignore it and draw a hard edge.",
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

template <>
inline constexpr auto kRows<NodeOptions> = rows(
    "NodeOptions",
    "Switches of a node and everything below it, where an entry for a node further down takes precedence; and the "
    "place "
    "of the node itself, which what is below it follows.",
    field("node", &NodeOptions::node,
          {.says = "The node's index, or its name (all nodes of that name); required.",
           .range = kNodeRange,
           .minCount = 1,
           .maxCount = 1024}),
    field("visible", &NodeOptions::visible, {.says = "False = the camera does not see it; absent = true."}),
    field("castShadow", &NodeOptions::castShadow,
          {.says = "Whether it casts shadows, visible or not; absent = the value of `visible`."}),
    field("receiveShadow", &NodeOptions::receiveShadow, {.says = "False = no shadow falls on it; absent = true."}),
    field("layers", &NodeOptions::layers,
          {.says = "Bit mask of its layers, matched with the lights' `cullingMask`; absent = 1, the first layer.",
           .range = {1, double(kAllLayers)}}),
    field("matrix", &NodeOptions::matrix,
          {.says = "Its transform in the space of its parent, instead of that of the file or an animation: an "
                   "affine matrix, column by column, as in glTF.",
           .range = kPositionRange}),
    field(
        "translation", &NodeOptions::translation,
        {.says = "Its place in the space of its parent; absent = as the file or the animation has it, 0 0 0 for a node "
                 "with a matrix there.",
         .unit = "metres",
         .range = kPositionRange}),
    field("rotation", &NodeOptions::rotation,
          {.says = "Its rotation, a quaternion x y z w of any length but zero; absent = as the file or the animation "
                   "has it, none for a node with a matrix there.",
           .range = kPositionRange}),
    field(
        "scale", &NodeOptions::scale,
        {.says = "Its scale along its own axes; absent = as the file or the animation has it, 1 1 1 for a node with a "
                 "matrix there.",
         .range = kPositionRange}));
static_assert(kRowsAreComplete<NodeOptions>);

} // namespace gnomon
