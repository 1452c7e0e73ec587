#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

/// Light by wavelength, as far as a sky needs it: in bands of 40 nm.
namespace gnomon {

inline constexpr std::size_t kBands = 8;
inline constexpr double kFirstBand = 400; ///< nm, its middle
inline constexpr double kBandWidth = 40;  ///< nm

/// A number of each band.
using Spectrum = std::array<float, kBands>;

/// The middle of a band, nm.
constexpr double wavelengthOf(std::size_t band) {
  return kFirstBand + kBandWidth * static_cast<double>(band);
}

/// Illuminance of a surface that faces the sun outside of the air, lux: IES, "Lighting Handbook", 9th edition (2000),
/// chapter 8.
inline constexpr double kSolarLux = 127'500;

/// Linear sRGB of sunlight of which each band has this share of what it has outside of the air. In that unit the whole
/// of it, Spectrum{1, 1, ...}, has luminance kSolarLux. Components of pure colors may be negative.
glm::dvec3 sunlightColor(const Spectrum& share);

/// The same luminance without negative components: paled as far as that needs.
glm::dvec3 withinSrgb(const glm::dvec3& color);

} // namespace gnomon
