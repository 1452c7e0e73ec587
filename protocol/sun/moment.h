#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/result.h"

/// A moment as RFC 3339 writes it: "2026-06-21T17:00:00+02:00".
namespace gnomon {

inline constexpr int kFirstYear = 1900;
inline constexpr int kLastYear = 2100;

/// Days have 86,400 seconds: leap seconds are not counted, as in the time of POSIX.
struct Moment {
  std::int64_t milliseconds = 0; ///< since 1970-01-01T00:00:00Z
  int zoneMinutes = 0;           ///< how far the clock is ahead of UTC

  bool operator==(const Moment&) const = default;
};

/// Seconds may be left out, and are read to the millisecond. A problem (without a pointer) for any other text, a day
/// that its month does not have, a leap second (":60"), a year outside of kFirstYear..kLastYear, and a missing zone.
Result<Moment> readMoment(std::string_view text);

/// By the clock of its zone; with milliseconds where there are any.
std::string momentText(const Moment& moment);

/// The moment at `share`, 0..1, of the way from one to the other, by the clock of the first.
Moment momentBetween(const Moment& from, const Moment& to, double share);

} // namespace gnomon
