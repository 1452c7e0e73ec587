#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/camera_rows.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/light_rows.h"
#include "protocol/spec/node_rows.h"
#include "protocol/spec/shadow_rows.h"

/// One row for each member of every struct that a frame's specification is made of. A new member without its row
/// does not compile. A default is not repeated here: it is the member's initialiser.
namespace gnomon {

template <>
inline constexpr auto kRows<Ambient> = rows(
    "Ambient", "Light of the surroundings: a neutral studio, brighter above than at the sides and below.",
    field("color", &Ambient::color, {.says = "Linear red, green and blue.", .range = kUnitRange}),
    field("intensity", &Ambient::intensity,
          {.says = "Mean radiance of the surroundings above, in the unit of the lights.", .range = kIntensityRange}));
static_assert(kRowsAreComplete<Ambient>);

template <>
inline constexpr auto kRows<Background> =
    rows("Background", "What stands where no surface is; neither exposed nor tone mapped.",
         field("color", &Background::color, {.says = "Linear red, green and blue.", .range = kUnitRange}),
         field("alpha", &Background::alpha, {.says = "0 = transparent, 1 = opaque.", .range = kUnitRange}));
static_assert(kRowsAreComplete<Background>);

template <>
inline constexpr auto kRows<Output> =
    rows("Output", "The picture's file.",
         field("format", &Output::format, {.says = "The kind of file where the Accept header names none."}),
         field("pngCompression", &Output::pngCompression, {.says = "0 = fastest, 9 = smallest.", .range = {0, 9}}),
         field("exrCompression", &Output::exrCompression, {.says = "Compression of an EXR, all without loss."}),
         field("exrPixelType", &Output::exrPixelType, {.says = "Width of an EXR's numbers."}));
static_assert(kRowsAreComplete<Output>);

template <>
inline constexpr auto kRows<Quality> =
    rows("Quality", "A target for the shadows: an error or a time.",
         field("maxError", &Quality::maxError,
               {.says = "Share of misclassified receivers at most: the cheapest settings that hold it on this view.",
                .range = kUnitRange}),
         field("maxMilliseconds", &Quality::maxMilliseconds,
               {.says = "Time of a whole warm frame at most, encoding apart: the most exact settings that fit.",
                .unit = "milliseconds",
                .range = {0, 1e6, true, false}}));
static_assert(kRowsAreComplete<Quality>);

template <>
inline constexpr auto kRows<AnimationMoment> =
    rows("AnimationMoment", "A moment of one of the file's animations, by its index or its name.",
         field("index", &AnimationMoment::index,
               {.says = "Index of the animation.", .range = {0, double(kLimits.maxAnimations - 1)}}),
         field("name", &AnimationMoment::name,
               {.says = "The first animation of that name.", .minCount = 1, .maxCount = 1024}),
         field("timeSeconds", &AnimationMoment::timeSeconds,
               {.says = "When; before its first and after its last keyframe, what is animated stands still.",
                .unit = "seconds",
                .range = {-1e9, 1e9}}))
        .withAlternatives({"index", "name"});
static_assert(kRowsAreComplete<AnimationMoment>);

template <>
inline constexpr auto kRows<Debug> =
    rows("Debug", "What the debug views show.",
         field("light", &Debug::light,
               {.says = "Index of the light; absent = the first that casts a shadow in this frame, or else the first.",
                .range = {0, kLimits.maxLights - 1.0}}),
         field("tile", &Debug::tile,
               {.says = "Which of its tiles the view `tile` shows: a cascade or a face.",
                .range = {0, kLimits.maxCascades - 1.0}}),
         field("predictEdges", &Debug::predictEdges,
               {.says = "The report says, without rays, how far the edges of its shadow map are expected to be off: "
                        "`predictedError.edgeDisplacement`. Takes about as long as shading twice."}));
static_assert(kRowsAreComplete<Debug>);

template <>
inline constexpr auto kRows<FrameSpec> = rows(
    "FrameSpec", "Everything that a frame depends on besides the scene; every field may be left out.",
    field("width", &FrameSpec::width, {.says = "Width of the picture.", .unit = "pixels", .range = kFrameSideRange}),
    field("height", &FrameSpec::height, {.says = "Height of the picture.", .unit = "pixels", .range = kFrameSideRange}),
    field("camera", &FrameSpec::camera, {.says = "Where the picture is taken from, and with which lens."}),
    field("lights", &FrameSpec::lights,
          {.says = "The lights; absent = the scene's own, or one sun where it has none.",
           .maxCount = kLimits.maxLights}),
    field("shadow", &FrameSpec::shadow, {.says = "The shadow of every light that has none of its own."}),
    field("shadowLightPolicy", &FrameSpec::shadowLightPolicy, {.says = "Which lights cast shadows."}),
    field("atlas", &FrameSpec::atlas, {.says = "The depth texture that holds every tile."}),
    field("nodes", &FrameSpec::nodes,
          {.says = "Switches of single nodes; of two for one node the later one counts.",
           .maxCount = kLimits.maxNodeOptions}),
    field("scene", &FrameSpec::scene,
          {.says = "Index of the glTF scene; absent = the file's default.", .range = kNodeRange}),
    field("materialVariant", &FrameSpec::materialVariant,
          {.says = "Name of one of the file's material variants; absent = the materials that the meshes name.",
           .maxCount = 1024}),
    field("animation", &FrameSpec::animation,
          {.says = "The pose of an animated scene; absent = as the file has it at rest."}),
    field("ambient", &FrameSpec::ambient,
          {.says = "The surroundings: a neutral studio, brighter above than at the sides and below."}),
    field("background", &FrameSpec::background, {.says = "What stands where no surface is."}),
    field("exposure", &FrameSpec::exposure,
          {.says = "Light is multiplied by 2 to this power before tone mapping.", .unit = "stops", .range = {-32, 32}}),
    field("toneMapping", &FrameSpec::toneMapping, {.says = "How light is fitted into a PNG."}),
    field("antialiasing", &FrameSpec::antialiasing, {.says = "How edges are smoothed."}),
    field("views", &FrameSpec::views,
          {.says = "What to show, each view once; a reply of one picture shows the first.",
           .minCount = 1,
           .maxCount = kSpellings<View>.size(),
           .distinct = true}),
    field("debug", &FrameSpec::debug, {.says = "What the debug views show."}),
    field("quality", &FrameSpec::quality,
          {.says = "A target for the shadows; their technique, filter, cascades and sizes are then chosen for it."}),
    field("output", &FrameSpec::output, {.says = "The picture's file."}));
static_assert(kRowsAreComplete<FrameSpec>);

} // namespace gnomon
