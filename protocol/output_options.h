#pragma once

#include <array>

namespace gnomon {

/// What a picture shows.
enum class View {
  color,    ///< the shaded scene
  depth,    ///< distance along the view axis: metres in EXR, near-to-far grey in PNG
  normal,   ///< world-space shading normal: -1..1 in EXR, 0..1 in PNG
  cascades, ///< the shaded scene tinted by cascade: green, blue, purple, red
  shadow,   ///< share of the first shadow-casting light that arrives, 0..1
  atlas     ///< the shadow atlas, depth as grey, at its own size
};

enum class ImageFormat { png, exr };
enum class ExrCompression { none, rle, zip, piz };
enum class ExrPixelType { half, float_ };
enum class ToneMapping { aces, none };
enum class Antialiasing { none, msaa4x };

struct Output {
  ImageFormat format = ImageFormat::png;
  int pngCompression = 2; ///< 0 fastest .. 9 smallest
  ExrCompression exrCompression = ExrCompression::piz;
  ExrPixelType exrPixelType = ExrPixelType::half; ///< JSON: "half" | "float"

  bool operator==(const Output&) const = default;
};

} // namespace gnomon
