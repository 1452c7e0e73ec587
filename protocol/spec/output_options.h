#pragma once

#include <array>

/// Rows of the fields: field_rows.h and enum_rows.h.
namespace gnomon {

/// What a picture shows.
enum class View {
  color,
  depth,
  normal,
  cascades,
  shadow,
  atlas,
  tile,
  texelGrid,
  texelDensity,
  blendWeight,
  bias,
  casterIds,
  lightContribution,
  reference,
  error,
  edgeDistance,
  ids,
  instances,
  materials,
  albedo,
  position,
  motion,
  sunHours
};

enum class ImageFormat { png, exr, npy, npz, tiff, jpeg, webp };

enum class ExrCompression { none, rle, zip, piz };
enum class ExrPixelType { half, float_ };

/// What the colors of an array are.
enum class ArrayColors { srgb, linear };

enum class ToneMapping { aces, neutral, agx, none };

/// What draws: a processor, or OpenGL.
enum class DeviceChoice { auto_, cpu, gl };
enum class Antialiasing { none, msaa4x };

struct Output {
  ImageFormat format = ImageFormat::png;
  int pngCompression = 2; ///< 0 fastest .. 9 smallest; up to 2 by ISA-L, from 3 on by libdeflate
  ExrCompression exrCompression = ExrCompression::piz;
  ExrPixelType exrPixelType = ExrPixelType::half;
  int pngBits = 8;
  ArrayColors arrayColors = ArrayColors::srgb;
  int jpegQuality = 90;
  int webpQuality = 85;

  bool operator==(const Output&) const = default;
};

/// What a depth sensor can measure, metres.
struct SensorRange {
  double min = 0; ///< what is nearer is too close
  double max = 0; ///< what is farther is too far
};

} // namespace gnomon
