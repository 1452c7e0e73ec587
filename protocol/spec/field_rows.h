#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/scene_rows.h"
#include "protocol/spec/shadow_rows.h"
#include "protocol/spec/volume_rows.h"

/// One row for each member of every struct that a frame's specification is made of. A new member without its row
/// does not compile. A default is not repeated here: it is the member's initialiser.
namespace gnomon {

template <>
inline constexpr auto kRows<Ambient> =
    rows("Ambient", "Light of the surroundings: a neutral studio, brighter above than at the sides and below.",
         field("color", &Ambient::color, {.says = "Linear red, green and blue.", .range = kUnitRange}),
         field("intensity", &Ambient::intensity,
               {.says = "Brightness of the surroundings from above, in the same unit as the lights; the default is a "
                        "tenth of a light's default intensity.",
                .range = kIntensityRange}));
static_assert(kRowsAreComplete<Ambient>);

template <>
inline constexpr auto kRows<Background> =
    rows("Background", "What is shown where there is no surface; neither exposed nor tone mapped.",
         field("color", &Background::color, {.says = "Linear red, green and blue.", .range = kUnitRange}),
         field("alpha", &Background::alpha, {.says = "0 = transparent, 1 = opaque.", .range = kUnitRange}));
static_assert(kRowsAreComplete<Background>);

template <>
inline constexpr auto kRows<Output> = rows(
    "Output", "The picture's file.",
    field("format", &Output::format, {.says = "File format if the Accept header names none."}),
    field(
        "pngCompression", &Output::pngCompression,
        {.says = "0 = largest file and fastest, 9 = smallest and slowest. The picture is the same at any level. 0 does "
                 "not compress; 1 and 2 take a few milliseconds; against 2, 3 takes about four times as long for 5 to "
                 "10 % less, 6 eight times for 10 to 20 % less, 9 a hundred times and more for 20 to 30 % less. The "
                 "default is the last one that is quick.",
         .range = {0, 9}}),
    field("exrCompression", &Output::exrCompression, {.says = "Compression of an EXR; all kinds are lossless."}),
    field(
        "exrPixelType", &Output::exrPixelType,
        {.says = "Bits of a number in an EXR: `half` has 11 bits of precision, `float` 24 and about twice the size."}),
    field("pngBits", &Output::pngBits,
          {.says = "Bits of a channel in a PNG. With 16, views of numbers hold them: `depth` in millimetres, rounded, "
                   "`ids`, `instances`, `materials` and `casterIds` as they are, 65535 where there is nothing or more "
                   "than fits; all others the same as with 8, but finer.",
           .range = {8, 16},
           .choices = choices(8, 16)}),
    field("arrayColors", &Output::arrayColors, {.says = "What colors are in `npy` and `npz`."}),
    field("jpegQuality", &Output::jpegQuality,
          {.says = "1 = smallest file, 100 = closest to the picture and about ten times as large.", .range = {1, 100}}),
    field("webpQuality", &Output::webpQuality,
          {.says = "0 = smallest file, 100 = closest to the picture and about ten times as large.",
           .range = {0, 100}}));
static_assert(kRowsAreComplete<Output>);

template <>
inline constexpr auto kRows<Quality> = rows(
    "Quality", "A target for the shadows: an error or a time.",
    field("maxError", &Quality::maxError,
          {.says = "Chooses the fastest settings that misclassify at most this share of the receivers in this view. "
                   "The first frame measures them and takes as long as about fifty; later ones reuse the choice.",
           .range = kUnitRange}),
    field("maxMilliseconds", &Quality::maxMilliseconds,
          {.says = "Chooses the most exact settings whose whole warm frame, without encoding, takes at most this long. "
                   "The first frame measures them and takes as long as about fifty; later ones reuse the choice.",
           .unit = "milliseconds",
           .range = {0, 1e6, true, false}}));
static_assert(kRowsAreComplete<Quality>);

template <>
inline constexpr auto kRows<AnimationMoment> =
    rows("AnimationMoment", "A moment of one of the file's animations, by index or name.",
         field("index", &AnimationMoment::index,
               {.says = "Index of the animation.", .range = {0, double(kLimits.maxAnimations - 1)}}),
         field("name", &AnimationMoment::name,
               {.says = "Name of the animation; the first of that name.", .minCount = 1, .maxCount = 1024}),
         field("timeSeconds", &AnimationMoment::timeSeconds,
               {.says = "Time within the animation. Before the first and after the last keyframe its values stay as "
                        "they are there.",
                .unit = "seconds",
                .range = {-1e9, 1e9}}))
        .withAlternatives({"index", "name"});
static_assert(kRowsAreComplete<AnimationMoment>);

template <>
inline constexpr auto kRows<MotionFrom> = rows(
    "MotionFrom", "What the view `motion` compares with; what is absent is as in the frame itself.",
    field("camera", &MotionFrom::camera, {.says = "The camera then."}),
    field("animation", &MotionFrom::animation, {.says = "The animation and its time then."}),
    field("nodes", &MotionFrom::nodes,
          {.says = "Places of nodes then, instead of the frame's `nodes`: of each entry only `matrix`, `translation`, "
                   "`rotation` and `scale`.",
           .maxCount = kLimits.maxNodeOptions}));
static_assert(kRowsAreComplete<MotionFrom>);

template <>
inline constexpr auto kRows<Debug> = rows(
    "Debug", "What the debug views show.",
    field("light", &Debug::light,
          {.says = "Index of the light that views of one light show; absent = the first light that casts a shadow in "
                   "this frame, or else the first light.",
           .range = {0, kLimits.maxLights - 1.0}}),
    field("tile", &Debug::tile,
          {.says = "Which tile of that light the view `tile` shows: a cascade or a face.",
           .range = {0, kLimits.maxCascades - 1.0}}),
    field("predictEdges", &Debug::predictEdges,
          {.says = "True = the report estimates, without rays, how far the edges of this light's shadow map are from "
                   "their true place (`predictedError.edgeDisplacement`). Costs about as much as shading twice."}));
static_assert(kRowsAreComplete<Debug>);

template <>
inline constexpr auto kRows<FrameSpec> = rows(
    "FrameSpec", "Everything that a frame depends on, apart from the scene; every field may be left out.",
    field("width", &FrameSpec::width,
          {.says = "Width of the picture. Time of shading grows with the number of pixels.",
           .unit = "pixels",
           .range = kFrameSideRange}),
    field("height", &FrameSpec::height, {.says = "Height of the picture.", .unit = "pixels", .range = kFrameSideRange}),
    field("camera", &FrameSpec::camera, {.says = "Where the picture is taken from, and with which lens."}),
    field("lights", &FrameSpec::lights,
          {.says = "The lights; absent = those of the scene, or one sun if it has none. Each shadow map needs "
                   "tiles of its own.",
           .maxCount = kLimits.maxLights}),
    field("shadow", &FrameSpec::shadow, {.says = "The shadow of every light that has no `shadow` of its own."}),
    field("shadowLightPolicy", &FrameSpec::shadowLightPolicy, {.says = "Which lights cast shadows."}),
    field("atlas", &FrameSpec::atlas, {.says = "The depth texture that holds every shadow tile."}),
    field("nodes", &FrameSpec::nodes,
          {.says = "Switches and places of single nodes; of two entries for one node, the later one applies.",
           .maxCount = kLimits.maxNodeOptions}),
    field("volumes", &FrameSpec::volumes,
          {.says = "Clouds, smoke and fog, in view `color`; they shade what the first directional light shines on that "
                   "casts shadows. Other views show surfaces alone, and `reference`, `error`, `edgeDistance` and "
                   "evaluations compare the shadows of surfaces alone.",
           .maxCount = kLimits.maxVolumes}),
    field("scene", &FrameSpec::scene,
          {.says = "Index of the glTF scene; absent = the file's default scene.", .range = kNodeRange}),
    field("materialVariant", &FrameSpec::materialVariant,
          {.says = "Name of one of the file's material variants (KHR_materials_variants); absent = the materials that "
                   "the meshes name.",
           .maxCount = 1024}),
    field("animation", &FrameSpec::animation,
          {.says = "The pose of an animated scene; absent = the file's rest pose."}),
    field("ambient", &FrameSpec::ambient,
          {.says = "Light from the surroundings: a neutral studio, brighter above than at the sides and below."}),
    field("background", &FrameSpec::background, {.says = "What is shown where there is no surface."}),
    field("exposure", &FrameSpec::exposure,
          {.says = "Light is multiplied by 2 to this power before tone mapping; each step up doubles it.",
           .unit = "stops",
           .range = {-32, 32}}),
    field("toneMapping", &FrameSpec::toneMapping,
          {.says = "How linear light is brought into the range of a PNG; an EXR is never tone mapped."}),
    field("antialiasing", &FrameSpec::antialiasing,
          {.says = "How edges of surfaces are smoothed. Four samples a pixel take two to three times as long to draw "
                   "on a CPU."}),
    field("views", &FrameSpec::views,
          {.says = "The views to draw, each once. A reply of one picture shows the first. Each view adds a pass over "
                   "the picture; `reference`, `error` and `edgeDistance` also trace rays.",
           .minCount = 1,
           .maxCount = kSpellings<View>.size(),
           .distinct = true}),
    field("motionFrom", &FrameSpec::motionFrom,
          {.says = "An earlier moment that the view `motion` compares with; required by that view."}),
    field("debug", &FrameSpec::debug, {.says = "What the debug views show."}),
    field("quality", &FrameSpec::quality,
          {.says = "A target for the shadows instead of settings: technique, filter, cascades and sizes are then "
                   "chosen to meet it."}),
    field(
        "device", &FrameSpec::device,
        {.says = "What draws the frame, where the server has a choice. Both draw the same picture within rounding; the "
                 "time differs."}),
    field("output", &FrameSpec::output, {.says = "Format and compression of the picture."}));
static_assert(kRowsAreComplete<FrameSpec>);

} // namespace gnomon
