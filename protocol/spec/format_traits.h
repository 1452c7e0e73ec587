#pragma once

#include <array>
#include <string_view>

#include "protocol/spec/enum_rows.h"
#include "protocol/spec/traits.h"

namespace gnomon {

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
