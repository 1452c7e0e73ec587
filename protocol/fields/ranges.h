#pragma once

#include "protocol/fields/fields.h"
#include "protocol/spec/limits.h"

/// The ranges that several rows share.
namespace gnomon {

inline constexpr Range kPositionRange{-1e9, 1e9};         ///< metres; keeps double exact to 1e-7 m
inline constexpr Range kLengthRange{0, 1e9, true, false}; ///< metres, not zero
inline constexpr Range kFocalRange{1e-3, 1e9};            ///< pixels
inline constexpr Range kPrincipalRange{-1e7, 1e7};        ///< pixels; may lie beside the picture
inline constexpr Range kIntensityRange{0, 1e9};           ///< brighter than the sun by four decades
inline constexpr Range kTemperatureRange{1000, 15000};    ///< kelvin; where the formula holds
inline constexpr Range kBiasRange{0, 1e6};
inline constexpr Range kUnitRange{0, 1};                                       ///< shares and linear colors
inline constexpr Range kAzimuthRange{-360, 360};                               ///< degrees
inline constexpr Range kElevationRange{-90, 90};                               ///< degrees
inline constexpr Range kFrameSideRange{1, double(kLimits.maxFrameSide)};       ///< pixels
inline constexpr Range kNodeRange{0, double(kLimits.maxNodes - 1)};            ///< an index
inline constexpr Choices kTexelSides = powersOfTwo(128, kLimits.maxAtlasSide); ///< XSmall of the least = 16

} // namespace gnomon
