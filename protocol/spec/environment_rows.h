#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/environment_options.h"
#include "protocol/spec/scene_rows.h"

/// The rows of environments and the ground; see field_rows.h.
namespace gnomon {

template <>
inline constexpr std::array kSpellings<EnvironmentBackground>{
    spelling<EnvironmentBackground::none>("`background`, as without an environment"),
    spelling<EnvironmentBackground::environment>("the environment, exposed and tone mapped as the scene is"),
    spelling<EnvironmentBackground::blurred>("the environment out of focus"),
};

template <>
inline constexpr std::array kSpellings<Studio>{
    spelling<Studio::lamps>("a dim room with a lamp overhead and three around the scene"),
    spelling<Studio::even>("the same all around, brighter above than at the sides and below"),
};

template <>
inline constexpr std::array kSpellings<EnvironmentShadows>{
    spelling<EnvironmentShadows::none>("all of its light arrives everywhere, but for occlusion textures"),
    spelling<EnvironmentShadows::rays>("rays find what the scene hides of it"),
};

template <>
inline constexpr std::array kSpellings<SunExtraction>{
    spelling<SunExtraction::auto_>("a bright disc becomes a directional light with its color, size and shadow"),
    spelling<SunExtraction::none>("it stays in the picture"),
    spelling<SunExtraction::removed>("it is taken out, and no light is added: what a report's `spec` says whose "
                                     "`lights` has it"),
};

template <>
inline constexpr std::array kSpellings<GroundMode>{
    spelling<GroundMode::catcher>("invisible but for the shadows on it"),
    spelling<GroundMode::surface>("a surface of `color` and `roughness`"),
};

template <>
inline constexpr auto kRows<Sky> = rows(
    "Sky", "A clear sky and its sun, computed from the sun's place.",
    field<&Sky::turbidity>("Haze of the air: 2 is a clear day in the mountains, 3 a clear day, 10 a hazy one.",
                           {.range = {1, 10}}),
    field<&Sky::albedo>("Linear red, green and blue share of light that the land all around reflects into the sky.",
                        {.range = kUnitRange}),
    field<&Sky::sun>("The sun's place in the sky. It becomes a directional light."));

template <>
inline constexpr auto kRows<EnvironmentOptions> =
    rows("EnvironmentOptions",
         "Light from all around: a picture of all directions, a computed sky, or the studio of `ambient`. Without "
         "`file`, "
         "`sky`, `light` and `studio`: what the glTF gives its scene, else the studio with lamps.",
         field<&EnvironmentOptions::file>("Name of a file of the upload: .hdr (Radiance) or .exr, twice as wide as "
                                          "high, linear radiance by longitude and latitude.",
                                          {.minCount = 1, .maxCount = 255}),
         field<&EnvironmentOptions::sky>("A computed sky instead of a file."),
         field<&EnvironmentOptions::light>(
             "Index of an image-based light of the glTF (EXT_lights_image_based); absent = "
             "that of the frame's scene, unless `file`, `sky` or `studio` is there.",
             {.range = {0, double(kLimits.maxImages)}}),
         field<&EnvironmentOptions::studio>("The neutral studio that lights the scene where there is no file, sky or "
                                            "light; `ambient` is its brightness and its color. Absent = lamps."),
         field<&EnvironmentOptions::rotationDegrees>(
             "Turns the environment about the vertical axis, clockwise as seen from above. At 0 the middle of a file's "
             "picture lies towards +X and its right half towards +Z, and a light lies as the glTF turns it.",
             {.unit = "degrees", .range = kAzimuthRange}),
         field<&EnvironmentOptions::intensity>(
             "Its light is multiplied by this, beside the glTF's own factor of a light; absent = 1, and 3e-5 for a "
             "sky, so that the sun at noon is as bright as "
             "a light's default intensity.",
             {.range = kIntensityRange}),
         field<&EnvironmentOptions::background>("What is shown where there is no surface."),
         field<&EnvironmentOptions::shadows>("Whether the scene hides a part of its light. Rays take about as long as "
                                             "a few soft shadows."),
         field<&EnvironmentOptions::samples>("Rays a pixel that look for what is hidden; more are sent where they "
                                             "disagree. Four times as many halve the noise and take four times as "
                                             "long.",
                                             {.range = {1, double(kLimits.maxRaySamples)}}),
         field<&EnvironmentOptions::extractSun>(
             "What becomes of the brightest disc of a file or a light, or of the sun of "
             "a sky."))
        .withAlternatives({"file", "sky", "light"});

template <>
inline constexpr auto kRows<Ground> = rows(
    "Ground", "A horizontal plane under the scene, seen from above alone.",
    field<&Ground::height>("Its height; absent = a hair below the lowest point that is seen, as posed.",
                           {.unit = "metres", .range = kPositionRange}),
    field<&Ground::mode>("What is seen of it."),
    field<&Ground::color>("Linear red, green and blue. In mode catcher view color doesn't show it, other views do.",
                          {.range = kUnitRange}),
    field<&Ground::roughness>("0 = a mirror, 1 = matt. In mode catcher view color doesn't show it, other views do.",
                              {.range = kUnitRange}),
    field<&Ground::size>("Length of its sides; absent = ten times the scene's largest side, of a catcher less "
                         "where no shadow can fall farther out.",
                         {.unit = "metres", .range = kLengthRange}));

} // namespace gnomon
