#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/camera.h"

/// The rows of a camera; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<EyeTarget> = rows(
    "EyeTarget", "Where the eye stands and what it looks at.",
    field("eye", &EyeTarget::eye,
          {.says = "Where the camera stands; 0 0 5 if only `target` or `up` is given.",
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
    rows("Orbit", "Where the camera stands on a sphere around a target.",
         field("target", &Orbit::target,
               {.says = "Centre of the sphere, at which the camera looks; absent = the centre of the scene.",
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
               {.says = "Distance from the eye to the target; absent = far enough to show the whole scene.",
                .unit = "metres",
                .range = kLengthRange}));
static_assert(kRowsAreComplete<Orbit>);

template <>
inline constexpr auto kRows<Perspective> =
    rows("Perspective", "A lens with perspective.",
         field("fovYDegrees", &Perspective::fovYDegrees,
               {.says = "Full vertical angle of view.", .unit = "degrees", .range = {0, 180, true, true}}),
         field("near", &Perspective::near,
               {.says = "Nearest depth that is drawn; absent = chosen from the scene's bounds.",
                .unit = "metres",
                .range = kLengthRange}),
         field("far", &Perspective::far,
               {.says = "Farthest depth that is drawn, more than `near`; absent = no limit.",
                .unit = "metres",
                .range = kLengthRange}));
static_assert(kRowsAreComplete<Perspective>);

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
               {.says = "Placement and lens of a camera in the scene, by its node's index or name.",
                .range = kNodeRange,
                .minCount = 1,
                .maxCount = 1024}),
         field("fit", &Camera::fit,
               {.says = "True = show the whole scene from the default direction; false is not accepted.",
                .onlyTrue = true}),
         field("perspective", &Camera::perspective,
               {.says = "A lens with perspective; absent = the lens of the camera node, or 45 degrees."}),
         field("orthographic", &Camera::orthographic,
               {.says = "A lens without perspective, instead of one with perspective."}))
        .withAlternatives({"lookAt", "orbit", "node", "fit"}, {"perspective", "orthographic"});
static_assert(kRowsAreComplete<Camera>);

} // namespace gnomon
