#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/environment_rows.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/scene_options.h"
#include "protocol/spec/scene_rows.h"
#include "protocol/spec/shadow_rows.h"

/// One row for each member of every struct that a frame's specification is made of. A new member without its row
/// does not compile. A default is not repeated here: it is the member's initialiser.
namespace gnomon {

template <>
inline constexpr auto kRows<Ambient> =
    rows("Ambient", "Light of the surroundings: a neutral studio, brighter above than at the sides and below.",
         field<&Ambient::color>("Linear red, green and blue.", {.range = kUnitRange}),
         field<&Ambient::intensity>("Brightness of the surroundings from above, in the same unit as the lights; the "
                                    "default is a fifth of a light's default intensity.",
                                    {.range = kIntensityRange}));

template <>
inline constexpr auto kRows<Background> =
    rows("Background", "What is shown where there is no surface; neither exposed nor tone mapped.",
         field<&Background::color>("Linear red, green and blue.", {.range = kUnitRange}),
         field<&Background::alpha>("0 = transparent, 1 = opaque.", {.range = kUnitRange}));

template <>
inline constexpr auto kRows<Output> = rows(
    "Output", "The picture's file.", field<&Output::format>("File format if the Accept header names none."),
    field<&Output::pngCompression>(
        "0 = largest file and fastest, 9 = smallest and slowest. The picture is the same at any level. 0 does not "
        "compress; 1 and 2 take a few milliseconds; against 2, 3 takes about four times as long for 5 to 10 % less, 6 "
        "eight times for 10 to 20 % less, 9 a hundred times and more for 20 to 30 % less. The default is the last one "
        "that is quick.",
        {.range = {0, 9}}),
    field<&Output::exrCompression>("Compression of an EXR; all kinds are lossless."),
    field<&Output::exrPixelType>(
        "Bits of a number in an EXR: `half` has 11 bits of precision, `float` 24 and about twice the size."),
    field<&Output::pngBits>("Bits of a channel in a PNG. With 16, views of numbers hold them: `depth` in millimetres, "
                            "rounded, `ids`, `instances`, `materials` and `casterIds` as they are, 65535 where there "
                            "is nothing or more than fits; all others the same as with 8, but finer.",
                            {.range = {8, 16}, .choices = choices(8, 16)}),
    field<&Output::arrayColors>("What colors are in `npy` and `npz`."),
    field<&Output::jpegQuality>("1 = smallest file, 100 = closest to the picture and about ten times as large.",
                                {.range = {1, 100}}),
    field<&Output::webpQuality>("0 = smallest file, 100 = closest to the picture and about ten times as large.",
                                {.range = {0, 100}}));

template <>
inline constexpr auto kRows<Quality> =
    rows("Quality", "A target for the shadows: an error or a time.",
         field<&Quality::maxError>(
             "Chooses the fastest settings that misclassify at most this share of the receivers in this view. The "
             "first frame measures them and takes as long as about fifty; later ones reuse the choice.",
             {.range = kUnitRange}),
         field<&Quality::maxMilliseconds>(
             "Chooses the most exact settings whose whole warm frame, without encoding, takes at most this long. The "
             "first frame measures them and takes as long as about fifty; later ones reuse the choice.",
             {.unit = "milliseconds", .range = {0, 1e6, true, false}}));

template <>
inline constexpr auto kRows<AnimationMoment> =
    rows("AnimationMoment", "A moment of one of the file's animations, by index or name.",
         field<&AnimationMoment::index>("Index of the animation.", {.range = {0, double(kLimits.maxAnimations - 1)}}),
         field<&AnimationMoment::name>("Name of the animation; the first of that name.",
                                       {.minCount = 1, .maxCount = 1024}),
         field<&AnimationMoment::timeSeconds>("Time within the animation. Before the first and after the last keyframe "
                                              "its values stay as they are there.",
                                              {.unit = "seconds", .range = {-1e9, 1e9}}))
        .withAlternatives({"index", "name"});

template <>
inline constexpr auto kRows<MotionFrom> = rows(
    "MotionFrom", "What the view `motion` compares with; what is absent is as in the frame itself.",
    field<&MotionFrom::camera>("The camera then."), field<&MotionFrom::animation>("The animation and its time then."),
    field<&MotionFrom::nodes>("Places of nodes then, instead of the frame's `nodes`: of each entry only `matrix`, "
                              "`translation`, `rotation` and `scale`.",
                              {.maxCount = kLimits.maxNodeOptions}));

template <>
inline constexpr auto kRows<Debug> = rows(
    "Debug", "What the debug views show.",
    field<&Debug::light>(
        "Index of the light that views of one light show, or \"environment\": views shadow, reference and error then "
        "show the share of its diffuse light that arrives, by luminance; absent = the first light that casts a "
        "shadow in this frame, or else the first light.",
        {.range = {0, kLimits.maxLights - 1.0}, .minCount = 1, .maxCount = 11}),
    field<&Debug::tile>("Which tile of that light the view `tile` shows: a cascade or a face.",
                        {.range = {0, kLimits.maxCascades - 1.0}}),
    field<&Debug::predictEdges>(
        "True = the report estimates, without rays, how far the edges of this light's shadow map are from their "
        "true place (`predictedError.edgeDisplacement`). Costs about as much as shading twice."));

template <>
inline constexpr auto kRows<FrameSpec> = rows(
    "FrameSpec", "Everything that a frame depends on, apart from the scene; every field may be left out.",
    field<&FrameSpec::width>("Width of the picture. Time of shading grows with the number of pixels.",
                             {.unit = "pixels", .range = kFrameSideRange}),
    field<&FrameSpec::height>("Height of the picture.", {.unit = "pixels", .range = kFrameSideRange}),
    field<&FrameSpec::camera>("Where the picture is taken from, and with which lens."),
    field<&FrameSpec::lights>("The lights; absent = those of the scene, or one sun of intensity 2 if it has none. Each "
                              "shadow map needs tiles "
                              "of its own.",
                              {.maxCount = kLimits.maxLights}),
    field<&FrameSpec::shadow>("The shadow of every light that has no `shadow` of its own."),
    field<&FrameSpec::shadowLightPolicy>("Which lights cast shadows."),
    field<&FrameSpec::atlas>("The depth texture that holds every shadow tile."),
    field<&FrameSpec::nodes>("Switches and places of single nodes; of two entries for one node, the later one applies.",
                             {.maxCount = kLimits.maxNodeOptions}),
    field<&FrameSpec::volumes>("Clouds, smoke and fog, in view `color`; they shade what the first directional light "
                               "shines on that casts shadows. Other views show surfaces alone, and `reference`, "
                               "`error`, `edgeDistance` and evaluations compare the shadows of surfaces alone.",
                               {.maxCount = kLimits.maxVolumes}),
    field<&FrameSpec::scene>("Index of the glTF scene; absent = the file's default scene.", {.range = kNodeRange}),
    field<&FrameSpec::materialVariant>("Name of one of the file's material variants (KHR_materials_variants); absent = "
                                       "the materials that the meshes name.",
                                       {.maxCount = 1024}),
    field<&FrameSpec::animation>("The pose of an animated scene; absent = the file's rest pose."),
    field<&FrameSpec::ambient>(
        "Light from the surroundings: a neutral studio, brighter above than at the sides and below."),
    field<&FrameSpec::environment>("Light from all around, which surfaces reflect and the scene may shade."),
    field<&FrameSpec::ground>("A plane under the scene that takes its shadows; absent = none."),
    field<&FrameSpec::background>("What is shown where there is no surface."),
    field<&FrameSpec::exposure>("Light is multiplied by 2 to this power before tone mapping; each step up doubles it.",
                                {.unit = "stops", .range = {-32, 32}}),
    field<&FrameSpec::toneMapping>("How linear light is brought into the range of a PNG; an EXR is never tone mapped."),
    field<&FrameSpec::antialiasing>(
        "How edges of surfaces are smoothed. Four samples a pixel take two to three times as long to draw on a CPU."),
    field<&FrameSpec::views>("The views to draw, each once. A reply of one picture shows the first. Each view adds a "
                             "pass over the picture; `reference`, `error` and `edgeDistance` also trace rays.",
                             {.minCount = 1, .maxCount = kSpellings<View>.size(), .distinct = true}),
    field<&FrameSpec::motionFrom>("An earlier moment that the view `motion` compares with; required by that view."),
    field<&FrameSpec::sunHours>("Place and time whose hours of direct sun the view `sunHours` shows; required by that "
                                "view. The frame's lights do not matter to it."),
    field<&FrameSpec::debug>("What the debug views show."),
    field<&FrameSpec::quality>("A target for the shadows instead of settings: technique, filter, cascades and sizes "
                               "are then chosen to meet it."),
    field<&FrameSpec::device>("What draws the frame, where the server has a choice. Both draw the same picture within "
                              "rounding; the time differs."),
    field<&FrameSpec::output>("Format and compression of the picture."));

inline constexpr Range kExtinctionRange{0, 1e6};
inline constexpr Range kGridValueRange{-1e9, 1e9};

template <>
inline constexpr auto kRows<VolumeBox> =
    rows("VolumeBox", "A box along the world's axes.",
         field<&VolumeBox::min>("Its lowest corner.", {.unit = "metres", .range = kPositionRange}),
         field<&VolumeBox::max>("Its highest corner, more than `min` along each axis.",
                                {.unit = "metres", .range = kPositionRange}));

template <>
inline constexpr auto kRows<TransferStop> = rows(
    "TransferStop", "Color and extinction of a value of the grid.",
    field<&TransferStop::value>("A value of the grid, more than that of the entry before.", {.range = kGridValueRange}),
    field<&TransferStop::color>("Linear red, green and blue that is scattered of the light that is taken away; 1 1 1 "
                                "for a cloud, 0 0 0 for soot.",
                                {.range = kUnitRange}),
    field<&TransferStop::extinction>("Light that is taken away on a metre: exp(-extinction) is let through.",
                                     {.unit = "per metre", .range = kExtinctionRange}));

template <>
inline constexpr auto kRows<VolumeOptions> =
    rows(
        "VolumeOptions",
        "A cloud, smoke or fog: numbers on a grid, which `node`, `box` or `matrix` places in the scene.",
        field<&VolumeOptions::file>("Name of a file of the upload: .npy (an array `[z, y, x]` of float32, float16 or "
                                    "uint8) or .vdb (OpenVDB); required.",
                                    {.minCount = 1, .maxCount = 255}),
        field<&VolumeOptions::grid>("Name of a float grid of a .vdb; absent = the only one.",
                                    {.minCount = 1, .maxCount = 255}),
        field<&VolumeOptions::node>(
            "A node of the scene that the volume is attached to and moves with, by its index or name: `box` or "
            "`matrix` is in its space, without both the grid fills the cube from 0 to 1 there. It is seen, casts and "
            "receives as the node does, whose layers do not matter.",
            {.range = kNodeRange, .minCount = 1, .maxCount = 1024}),
        field<&VolumeOptions::box>("The box that the grid fills."),
        field<&VolumeOptions::matrix>("Instead of `box`: the affine matrix, column by column, that takes the unit cube "
                                      "which the grid fills into the world, in metres, or into the space of `node`.",
                                      {.range = kPositionRange}),
        field<&VolumeOptions::transferFunction>("What values of the grid mean, in ascending order: linear between two "
                                                "entries, and beyond the first and last as these say; required.",
                                                {.minCount = 1, .maxCount = kLimits.maxTransferStops}),
        field<&VolumeOptions::castShadow>("False = it dims the light of no surface and no volume, itself included."),
        field<&VolumeOptions::receiveShadow>("False = no surface and no volume shades it."))
        .withAlternatives({"box", "matrix"});

} // namespace gnomon
