#include "clients/cli/spec/sun_text.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "clients/cli/spec/spec_arguments.h"
#include "protocol/base/text.h"
#include "protocol/sun/moment.h"

namespace gnomon::cli {
namespace {

/// The midnight that a date begins with; nothing where the text is no date.
std::optional<Moment> midnightOf(std::string_view date, double longitudeDegrees) {
  constexpr std::size_t kDateLength = 10; // YYYY-MM-DD
  if (date.size() != kDateLength) return std::nullopt;
  auto moment = readMoment(std::string(date) + "T00:00Z");
  if (!moment) return std::nullopt;
  constexpr double kMinutesPerDegree = 24 * 60 / 360.0;
  moment->zoneMinutes = static_cast<int>(std::lround(std::clamp(longitudeDegrees, -180.0, 180.0) * kMinutesPerDegree));
  moment->milliseconds -= std::int64_t{moment->zoneMinutes} * 60'000;
  return *moment;
}

std::string timeOf(std::string_view text, double longitudeDegrees) {
  const auto midnight = midnightOf(text, longitudeDegrees);
  return midnight ? momentText(*midnight) : std::string(text);
}

Moment dayAfter(Moment moment) {
  moment.milliseconds += 86'400'000;
  return moment;
}

struct PlaceAndTime {
  double latitudeDegrees = 0, longitudeDegrees = 0;
  std::string_view time;
};

std::optional<PlaceAndTime> placeAndTimeOf(std::string_view text) {
  const auto space = text.find(' ');
  if (space == text.npos) return std::nullopt;
  const auto place = parseNumbers(text.substr(0, space), 2, 2);
  if (!place) return std::nullopt;
  return PlaceAndTime{(*place)[0], (*place)[1], trimmed(text.substr(space))};
}

} // namespace

std::optional<Sun> sunOf(const std::string& text) {
  if (const auto there = placeAndTimeOf(text)) {
    return Sun{.latitudeDegrees = there->latitudeDegrees,
               .longitudeDegrees = there->longitudeDegrees,
               .time = std::string(there->time)};
  }
  const auto angles = parseNumbers(text, 2, 2);
  if (!angles) return std::nullopt;
  return Sun{.azimuthDegrees = (*angles)[0], .elevationDegrees = (*angles)[1]};
}

std::optional<SunHours> sunHoursOf(const std::string& text) {
  const auto there = placeAndTimeOf(text);
  if (!there) return std::nullopt;
  SunHours hours{.latitudeDegrees = there->latitudeDegrees, .longitudeDegrees = there->longitudeDegrees};
  const auto slash = there->time.find('/');
  if (slash != there->time.npos) {
    hours.begin = timeOf(there->time.substr(0, slash), there->longitudeDegrees);
    hours.end = timeOf(there->time.substr(slash + 1), there->longitudeDegrees);
    return hours;
  }
  const auto midnight = midnightOf(there->time, there->longitudeDegrees);
  if (!midnight) return std::nullopt;
  hours.begin = momentText(*midnight);
  hours.end = momentText(dayAfter(*midnight));
  return hours;
}

} // namespace gnomon::cli
