#include "protocol/sun/moment.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "protocol/base/text.h"

namespace gnomon {
namespace {

constexpr std::int64_t kMinute = 60'000; ///< milliseconds
constexpr std::int64_t kDay = 24 * 60 * kMinute;
constexpr const char* kForm = "YYYY-MM-DDThh:mm:ss and Z or +hh:mm, e.g. 2026-06-21T17:00:00+02:00";

Problem refused(std::string_view text, const std::string& detail, const std::string& limit = kForm) {
  return invalidValue("", detail, limit, shortened(asUtf8(text), 60));
}

/// Takes what it reads off the front of a text.
class Reader {
 public:
  explicit Reader(std::string_view text) : left_(text) {}

  bool take(std::string_view anyOf) {
    if (left_.empty() || anyOf.find(left_[0]) == std::string_view::npos) return false;
    left_.remove_prefix(1);
    return true;
  }

  /// Exactly `count` digits.
  std::optional<int> number(std::size_t count) {
    if (left_.size() < count) return std::nullopt;
    int value = 0;
    for (const char c : left_.substr(0, count)) {
      if (c < '0' || c > '9') return std::nullopt;
      value = 10 * value + (c - '0');
    }
    left_.remove_prefix(count);
    return value;
  }

  /// Digits after the point, 1 to 9 of them.
  std::optional<int> fractionMilliseconds() {
    int value = 0;
    std::size_t digits = 0;
    for (; digits < left_.size() && left_[digits] >= '0' && left_[digits] <= '9'; ++digits) {
      if (digits < 3) value = 10 * value + (left_[digits] - '0');
    }
    if (digits == 0 || digits > 9) return std::nullopt;
    for (std::size_t i = digits; i < 3; ++i) value *= 10;
    left_.remove_prefix(digits);
    return value;
  }

  bool atEnd() const { return left_.empty(); }

 private:
  std::string_view left_;
};

struct Clock {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, milliseconds = 0;
};

bool readDate(Reader& reader, Clock& clock) {
  const auto year = reader.number(4);
  if (!year || !reader.take("-")) return false;
  const auto month = reader.number(2);
  if (!month || !reader.take("-")) return false;
  const auto day = reader.number(2);
  if (!day) return false;
  clock.year = *year, clock.month = *month, clock.day = *day;
  return true;
}

bool readTime(Reader& reader, Clock& clock) {
  const auto hour = reader.number(2);
  if (!hour || !reader.take(":")) return false;
  const auto minute = reader.number(2);
  if (!minute) return false;
  clock.hour = *hour, clock.minute = *minute;
  if (!reader.take(":")) return true;
  const auto second = reader.number(2);
  if (!second) return false;
  clock.second = *second;
  if (!reader.take(".")) return true;
  const auto fraction = reader.fractionMilliseconds();
  if (!fraction) return false;
  clock.milliseconds = *fraction;
  return true;
}

/// Minutes ahead of UTC.
std::optional<int> readZone(Reader& reader) {
  if (reader.take("Zz")) return 0;
  const bool ahead = reader.take("+");
  if (!ahead && !reader.take("-")) return std::nullopt;
  const auto hours = reader.number(2);
  if (!hours || *hours > 23 || !reader.take(":")) return std::nullopt;
  const auto minutes = reader.number(2);
  if (!minutes || *minutes > 59) return std::nullopt;
  return (ahead ? 1 : -1) * (*hours * 60 + *minutes);
}

} // namespace

Result<Moment> readMoment(std::string_view text) {
  Reader reader(text);
  Clock clock;
  if (!readDate(reader, clock) || !reader.take("Tt ") || !readTime(reader, clock)) {
    return refused(text, "This is no date and time of RFC 3339.");
  }
  if (reader.atEnd()) return refused(text, "A time needs its zone: Z for UTC, or how far the clock is ahead of it.");
  const auto zone = readZone(reader);
  if (!zone || !reader.atEnd()) return refused(text, "The zone of this time can't be read.", "Z, or +hh:mm or -hh:mm");
  if (clock.second == 60) {
    return refused(text, "Leap seconds are not supported; give the second before or after.", "seconds 0..59");
  }
  const std::chrono::year_month_day date{std::chrono::year(clock.year),
                                         std::chrono::month(static_cast<unsigned>(clock.month)),
                                         std::chrono::day(static_cast<unsigned>(clock.day))};
  if (clock.hour > 23 || clock.minute > 59 || clock.second > 60 || !date.ok()) {
    return refused(text, "There is no such day or time of day.");
  }
  if (clock.year < kFirstYear || clock.year > kLastYear) {
    return refused(text, "The sun's place is not known well enough in this year.",
                   std::to_string(kFirstYear) + ".." + std::to_string(kLastYear));
  }
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  const std::int64_t minutes = clock.hour * 60 + clock.minute - *zone;
  return Moment{days * kDay + minutes * kMinute + clock.second * 1000 + clock.milliseconds, *zone};
}

std::string momentText(const Moment& moment) {
  const std::int64_t local = moment.milliseconds + moment.zoneMinutes * kMinute;
  const std::int64_t day = (local >= 0 ? local : local - (kDay - 1)) / kDay;
  const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(day))};
  const int ofDay = static_cast<int>(local - day * kDay);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), ofDay / 3'600'000,
                ofDay / 60'000 % 60, ofDay / 1000 % 60);
  std::string result = text.data();
  if (ofDay % 1000 != 0) {
    std::snprintf(text.data(), text.size(), ".%03d", ofDay % 1000);
    result += text.data();
  }
  if (moment.zoneMinutes == 0) return result + "Z";
  const int zone = std::abs(moment.zoneMinutes);
  std::snprintf(text.data(), text.size(), "%c%02d:%02d", moment.zoneMinutes > 0 ? '+' : '-', zone / 60, zone % 60);
  return result + text.data();
}

Moment momentBetween(const Moment& from, const Moment& to, double share) {
  const auto way = static_cast<double>(to.milliseconds - from.milliseconds);
  return {from.milliseconds + std::llround(share * way), from.zoneMinutes};
}

} // namespace gnomon
