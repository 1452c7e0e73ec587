#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "protocol/spec/enum_rows.h"

namespace gnomon {

/// What a view's pixels are taken from.
enum class ViewSource {
  picture, ///< the lit surfaces, antialiased as the spec asks; alpha where the background is not opaque
  data,    ///< the surface at the pixel's centre: never averaged
  atlas,   ///< the shadow atlas, at a size of its own
  rays,    ///< a traced reference that the shadow of debug.light is compared with
  geometry ///< the triangle at the pixel's centre: numbers that no device makes, so that all give the same
};

/// Names of up to three channels; the rest is empty.
using ChannelNames = std::array<std::string_view, 3>;

/// What a view is and needs: one row each, complete by static_assert.
struct ViewTraits {
  View view;
  ViewSource source;
  bool material;    ///< shows what surfaces are made of: their textures are needed
  bool shadowed;    ///< shows the shadow that the light's technique makes
  bool oneLight;    ///< shows debug.light alone
  bool tiles;       ///< looks into the tiles of a shadow map, whatever decides the light's shadow
  bool backdrop;    ///< painted over the color view
  bool srgb;        ///< PNG: light, as sRGB has it; else bytes are numbers
  bool wide;        ///< EXR: always floats, as halfs can't hold its numbers
  ChannelNames png; ///< 8 bits a channel
  ChannelNames exr; ///< numbers
};

namespace channels {
inline constexpr ChannelNames kRgb{"R", "G", "B"};
inline constexpr ChannelNames kXyz{"X", "Y", "Z"};
inline constexpr ChannelNames kXy{"X", "Y"};
inline constexpr ChannelNames kValue{"Y"};
inline constexpr ChannelNames kDepth{"Z"};
inline constexpr ChannelNames kId{"id"};
} // namespace channels

// clang-format off
inline constexpr std::array kViewTraits{
    //               view               source                material shadowed light  tiles  backdrop srgb   wide   PNG              EXR
    ViewTraits{View::color,             ViewSource::picture,  true,    true,    false, false, false,   true,  false, channels::kRgb,  channels::kRgb},
    ViewTraits{View::depth,             ViewSource::data,     false,   false,   false, false, false,   false, true,  channels::kValue,channels::kDepth},
    ViewTraits{View::normal,            ViewSource::data,     true,    false,   false, false, false,   false, false, channels::kRgb,  channels::kXyz},
    ViewTraits{View::cascades,          ViewSource::picture,  true,    true,    true,  true,  false,   true,  false, channels::kRgb,  channels::kRgb},
    ViewTraits{View::shadow,            ViewSource::data,     false,   true,    true,  false, false,   false, false, channels::kValue,channels::kValue},
    ViewTraits{View::atlas,             ViewSource::atlas,    false,   false,   false, true,  false,   false, true,  channels::kRgb,  channels::kDepth},
    ViewTraits{View::tile,              ViewSource::atlas,    false,   false,   true,  true,  false,   false, true,  channels::kValue,channels::kDepth},
    ViewTraits{View::texelGrid,         ViewSource::picture,  true,    true,    true,  true,  false,   true,  false, channels::kRgb,  channels::kRgb},
    ViewTraits{View::texelDensity,      ViewSource::data,     false,   false,   true,  true,  false,   false, false, channels::kRgb,  channels::kValue},
    ViewTraits{View::blendWeight,       ViewSource::data,     false,   false,   true,  true,  false,   false, false, channels::kValue,channels::kValue},
    ViewTraits{View::bias,              ViewSource::data,     false,   false,   true,  true,  false,   false, false, channels::kRgb,  channels::kValue},
    ViewTraits{View::casterIds,         ViewSource::data,     false,   false,   true,  false, false,   false, true,  channels::kRgb,  channels::kId},
    ViewTraits{View::lightContribution, ViewSource::picture,  true,    true,    true,  false, false,   true,  false, channels::kRgb,  channels::kRgb},
    ViewTraits{View::reference,         ViewSource::rays,     false,   false,   true,  false, false,   false, false, channels::kValue,channels::kValue},
    ViewTraits{View::error,             ViewSource::rays,     false,   false,   true,  false, true,    false, false, channels::kRgb,  channels::kValue},
    ViewTraits{View::edgeDistance,      ViewSource::rays,     false,   false,   true,  false, true,    false, false, channels::kRgb,  channels::kValue},
    ViewTraits{View::ids,               ViewSource::geometry, false,   false,   false, false, false,   false, true,  channels::kRgb,  channels::kId},
    ViewTraits{View::instances,         ViewSource::geometry, false,   false,   false, false, false,   false, true,  channels::kRgb,  channels::kId},
    ViewTraits{View::materials,         ViewSource::geometry, false,   false,   false, false, false,   false, true,  channels::kRgb,  channels::kId},
    ViewTraits{View::albedo,            ViewSource::data,     true,    false,   false, false, false,   true,  false, channels::kRgb,  channels::kRgb},
    ViewTraits{View::position,          ViewSource::geometry, false,   false,   false, false, false,   false, true,  channels::kRgb,  channels::kXyz},
    ViewTraits{View::motion,            ViewSource::geometry, false,   false,   false, false, false,   false, true,  channels::kRgb,  channels::kXy},
    ViewTraits{View::sunHours,          ViewSource::geometry, false,   false,   false, false, false,   false, true,  channels::kRgb,  channels::kValue},
};
// clang-format on
static_assert(rowsAreComplete(kViewTraits, &ViewTraits::view));

constexpr const ViewTraits& traitsOf(View view) {
  return kViewTraits[static_cast<std::size_t>(view)];
}

/// What a kind of light is and has: one row each, complete by static_assert.
struct LightTraits {
  LightType type;
  bool parallel;                      ///< rays of one direction; else from a position, falling off with the distance
  bool directed;                      ///< has a direction
  bool hasCone;                       ///< shines within a cone about its direction
  std::optional<double> Light::*size; ///< what gives it penumbras
  std::size_t cubeFaces;              ///< that its shadow map may take; 0 = it takes cascades
  ShadowSize usualSize;               ///< of one tile, where a request leaves it open
};

// clang-format off
inline constexpr std::array kLightTraits{
    //          type                    parallel directed cone   size                            faces usual size
    LightTraits{LightType::directional, true,    true,    false, &Light::angularDiameterDegrees, 0,    ShadowSize::Large},
    LightTraits{LightType::spot,        false,   true,    true,  &Light::radius,                 5,    ShadowSize::Medium}, // no cone below a half space reaches the back
    LightTraits{LightType::point,       false,   false,   false, &Light::radius,                 6,    ShadowSize::Small},
};
// clang-format on
static_assert(rowsAreComplete(kLightTraits, &LightTraits::type));

constexpr const LightTraits& traitsOf(LightType type) {
  return kLightTraits[static_cast<std::size_t>(type)];
}

/// What a shadow technique is and needs: one row each, complete by static_assert.
struct TechniqueTraits {
  ShadowTechnique technique;
  bool layered;            ///< says of every sample what share of the light arrives; else shadow maps do
  bool traced;             ///< traces rays
  bool baked;              ///< looks the shadow up in a texture that was traced before, and traces no pixel
  bool needsEdges;         ///< needs to know the edges of the casters' meshes
  bool knowsSize;          ///< soft where the light has a size
  bool needsOpaqueCasters; ///< ignores the holes of a masked or blended caster
};

// clang-format off
inline constexpr std::array kTechniqueTraits{
    //               technique                    layered traced baked  edges  size   opaque
    TechniqueTraits{ShadowTechnique::auto_,        false, false, false, false, false, false}, // settled before it matters
    TechniqueTraits{ShadowTechnique::shadowMap,    false, false, false, false, false, false},
    TechniqueTraits{ShadowTechnique::shadowVolume, true,  false, false, true,  false, true},
    TechniqueTraits{ShadowTechnique::rayTraced,    true,  true,  false, false, true,  false},
    TechniqueTraits{ShadowTechnique::lightMap,     true,  true,  true,  false, true,  false},
};
// clang-format on
static_assert(rowsAreComplete(kTechniqueTraits, &TechniqueTraits::technique));

constexpr const TechniqueTraits& traitsOf(ShadowTechnique technique) {
  return kTechniqueTraits[static_cast<std::size_t>(technique)];
}

/// What a filter of shadow maps is, whatever its size: one row each, complete by static_assert.
struct FilterTraits {
  FilterType type;
  bool sized;   ///< size and radius have a meaning
  bool moments; ///< what it reads is made of depths before: their moments, blurred
  int taps;     ///< texels that it reads for a pixel, about; 0 = as its size or radius has it
};

// clang-format off
inline constexpr std::array kFilterTraits{
    //           type              sized  moments taps
    FilterTraits{FilterType::hard, false, false,  4},
    FilterTraits{FilterType::pcf,  true,  false,  0},
    FilterTraits{FilterType::vsm,  true,  true,   4},
    FilterTraits{FilterType::evsm, true,  true,   4},
    FilterTraits{FilterType::msm,  true,  true,   4},
    FilterTraits{FilterType::pcss, false, false,  64},
};
// clang-format on
static_assert(rowsAreComplete(kFilterTraits, &FilterTraits::type));

constexpr const FilterTraits& traitsOf(FilterType type) {
  return kFilterTraits[static_cast<std::size_t>(type)];
}

/// What a view's pixels are before they are encoded.
enum class PixelType {
  bytes,  ///< 8 bits a channel, as it is seen: tone mapped, sRGB, numbers as colors or grey
  words,  ///< the same with 16 bits a channel; views whose `wordsAreNumbers` hold those
  numbers ///< linear floats
};

/// Which pixels a format takes.
enum class FormatPixels {
  seen,           ///< bytes
  seenFiner,      ///< bytes, or words by `pngBits`
  numbers,        ///< numbers
  numbersOrColors ///< numbers; colors by `arrayColors`
};

/// What a format's files are: one row each, complete by static_assert.
struct FormatTraits {
  ImageFormat format;
  std::string_view mediaType;
  std::string_view suffix;      ///< of its files
  std::string_view otherSuffix; ///< means the same; empty = there is none
  FormatPixels pixels;
  bool allViews;   ///< one file holds every view; else each view has its own
  bool hasReport;  ///< the file holds the frame's report, too, and with it times
  bool inBrowsers; ///< browsers list it for every picture that they ask for
};

// clang-format off
inline constexpr std::array kFormatTraits{
    //           format             media type           suffix   other    pixels                         all views report browsers
    FormatTraits{ImageFormat::png,  "image/png",         ".png",  "",      FormatPixels::seenFiner,       false,    false, true},
    FormatTraits{ImageFormat::exr,  "image/x-exr",       ".exr",  "",      FormatPixels::numbers,         true,     false, false},
    FormatTraits{ImageFormat::npy,  "application/x-npy", ".npy",  "",      FormatPixels::numbersOrColors, false,    false, false},
    FormatTraits{ImageFormat::npz,  "application/zip",   ".npz",  "",      FormatPixels::numbersOrColors, true,     true,  false},
    FormatTraits{ImageFormat::tiff, "image/tiff",        ".tiff", ".tif",  FormatPixels::numbers,         false,    false, false},
    FormatTraits{ImageFormat::jpeg, "image/jpeg",        ".jpg",  ".jpeg", FormatPixels::seen,            false,    false, true},
    FormatTraits{ImageFormat::webp, "image/webp",        ".webp", "",      FormatPixels::seen,            false,    false, true},
};
// clang-format on
static_assert(rowsAreComplete(kFormatTraits, &FormatTraits::format));

constexpr const FormatTraits& traitsOf(ImageFormat format) {
  return kFormatTraits[static_cast<std::size_t>(format)];
}

/// A view of whole numbers: indices, -1 = nothing.
constexpr bool holdsIndices(View view) {
  return traitsOf(view).exr == channels::kId;
}

/// A view that has its numbers in 16 bits, as `pngBits` says; of all others they are a finer picture.
constexpr bool wordsAreNumbers(View view) {
  return view == View::depth || holdsIndices(view);
}

constexpr PixelType pixelTypeOf(View view, const Output& output) {
  switch (traitsOf(output.format).pixels) {
    case FormatPixels::seen:
      return PixelType::bytes;
    case FormatPixels::seenFiner:
      return output.pngBits == 16 ? PixelType::words : PixelType::bytes;
    case FormatPixels::numbers:
      return PixelType::numbers;
    case FormatPixels::numbersOrColors:
      return traitsOf(view).srgb && output.arrayColors == ArrayColors::srgb ? PixelType::bytes : PixelType::numbers;
  }
  return PixelType::bytes;
}

} // namespace gnomon
