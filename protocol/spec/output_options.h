#pragma once

#include <array>

namespace gnomon {

/// What a picture shows.
enum class View {
  color,             ///< the shaded scene
  depth,             ///< distance along the view axis: metres in EXR, near-to-far grey in PNG
  normal,            ///< world-space shading normal: -1..1 in EXR, 0..1 in PNG
  cascades,          ///< the shaded scene tinted by cascade: green, blue, purple, red; grey where no tile serves
  shadow,            ///< share of debug.light that arrives, 0..1; 1 where it casts none
  atlas,             ///< the shadow atlas at its own size: grey with tiles outlined and named, or raw depth (EXR)
  tile,              ///< depths of one tile, debug.tile of debug.light, at its own size
  texelGrid,         ///< the shaded scene with the texels of debug.light as a checkerboard; grey where it has none
  texelDensity,      ///< pixels that a texel of debug.light spans at most: heat map, or the number (EXR); 0 = no texel
  blendWeight,       ///< share of debug.light's next cascade, 0..1
  bias,              ///< metres that a point is moved for debug.light: heat map, or the number (EXR); 0 = no tile
  casterIds,         ///< node that throws the shadow of debug.light: a color for each, or its index (EXR), -1 = none
  lightContribution, ///< the shaded scene in nothing but debug.light, not even the background
  reference,         ///< share of debug.light that is really seen, traced; 1 where nothing receives its shadow
  error,             ///< false shadow red, false light blue; or shadow less reference (EXR), 0 where no receiver
  edgeDistance,      ///< pixels from an edge of debug.light's shadow to the nearest true one (EXR: -1 = no edge)
  ids,               ///< node that is seen: a color for each, or its index (EXR), -1 = none
  instances,         ///< copy of that node's mesh that is seen, as ids; 0 where there is but one
  materials,         ///< material that is seen, as ids; -1 = none, or a surface without one
  albedo,            ///< base color, without light: sRGB, or linear (EXR); black where nothing is
  position, ///< world-space point: a color by its place in the scene's bounds, or metres (EXR), infinity = none
  motion    ///< how far it has moved in the picture since motionFrom: x right, y down, pixels (EXR); infinity = none
};

enum class ImageFormat { png, exr, npy, npz, tiff, jpeg, webp };

enum class ExrCompression { none, rle, zip, piz };
enum class ExrPixelType { half, float_ };

/// What the colors of an array are.
enum class ArrayColors { srgb, linear };

enum class ToneMapping { aces, none };

/// What draws: a processor, or OpenGL.
enum class DeviceChoice { auto_, cpu, gl };
enum class Antialiasing { none, msaa4x };

struct Output {
  ImageFormat format = ImageFormat::png;
  int pngCompression = 2; ///< 0 fastest .. 9 smallest; up to 2 by ISA-L, from 3 on by libdeflate
  ExrCompression exrCompression = ExrCompression::piz;
  ExrPixelType exrPixelType = ExrPixelType::half; ///< JSON: "half" | "float"
  int pngBits = 8;                                ///< of a channel: 8 or 16
  ArrayColors arrayColors = ArrayColors::srgb;    ///< of npy and npz
  int jpegQuality = 90;                           ///< 1 smallest .. 100 best
  int webpQuality = 85;                           ///< 0 smallest .. 100 best; lossy at any

  bool operator==(const Output&) const = default;
};

} // namespace gnomon
