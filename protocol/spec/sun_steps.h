#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "protocol/spec/validate.h"

/// The moments at which view sunHours looks for the sun. Days have 24 hours and start at the time of day of `begin`.
namespace gnomon {

inline constexpr std::int64_t kMostSunSteps = 10000; ///< day and night, of all days that are looked at

/// A piece of time that the sun's place in its middle stands for.
struct SunStep {
  Sun sun;          ///< settled: azimuth and elevation in the scene
  double hours = 0; ///< that it counts: its length times the days that its day stands for
};

/// How many there are, day and night. REQUIRES: both times can be read.
std::int64_t sunStepCount(const SunHours& asked);

/// Those in whose middle the sun's centre is above the horizon, in their order. Steps begin at the start of each day;
/// the last one of a day, or of all, may be shorter. REQUIRES: appendSunHoursRules finds nothing.
std::vector<SunStep> sunSteps(const SunHours& asked);

/// What is wrong with the times, their order and how many steps they make.
void appendSunHoursRules(const FrameSpec& spec, std::vector<BrokenRule>& broken);

} // namespace gnomon
