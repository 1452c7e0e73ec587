#include "protocol/spec/sun_steps.h"

#include <algorithm>
#include <cmath>

#include "protocol/fields/field_checks.h"
#include "protocol/spec/settled_sun.h"
#include "protocol/sun/moment.h"

namespace gnomon {
namespace {

constexpr std::int64_t kDay = 86'400'000; ///< milliseconds
constexpr double kHour = 3'600'000;

struct Span {
  Moment begin;
  std::int64_t length = 0; ///< milliseconds
};

Span spanOf(const SunHours& asked) {
  const Moment begin = *readMoment(asked.begin);
  return {begin, readMoment(asked.end)->milliseconds - begin.milliseconds};
}

std::int64_t stepOf(const SunHours& asked) {
  return std::max<std::int64_t>(1, std::llround(asked.stepMinutes * 60'000));
}

std::int64_t dividedUp(std::int64_t length, std::int64_t by) {
  return (length + by - 1) / by;
}

void appendTimeRule(const std::string& text, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const auto moment = readMoment(text);
  if (moment) return;
  Problem problem = moment.problems().front();
  problem.pointer = pointer;
  if (text.empty()) problem = invalidValue(pointer, "Hours of sun need a time to begin and one to end.", "", "absent");
  broken.push_back({problem, {pointer}});
}

void appendSpanRules(const SunHours& asked, std::vector<BrokenRule>& broken) {
  const std::vector<std::string> times = {"/sunHours/begin", "/sunHours/end"};
  const std::int64_t length = spanOf(asked).length;
  if (length <= 0) {
    broken.push_back(
        {invalidValue("/sunHours/end", "The end must be later than the beginning.", "after " + asked.begin, asked.end),
         times});
    return;
  }
  if (asked.stepDays > 1 && length % kDay != 0) {
    broken.push_back({invalidValue("/sunHours/end", "Days can stand for others only where all are whole days.",
                                   "a multiple of 24 hours after " + asked.begin, asked.end),
                      {times[0], times[1], "/sunHours/stepDays"}});
  }
  const std::int64_t steps = sunStepCount(asked);
  if (steps <= kMostSunSteps) return;
  broken.push_back(
      {invalidValue("/sunHours", "These are too many steps. Longer steps or more stepDays make them fewer.",
                    "at most " + std::to_string(kMostSunSteps) + " steps", std::to_string(steps)),
       {times[0], times[1], "/sunHours/stepMinutes", "/sunHours/stepDays"}});
}

} // namespace

std::int64_t sunStepCount(const SunHours& asked) {
  const std::int64_t length = spanOf(asked).length, step = stepOf(asked);
  const std::int64_t stride = kDay * asked.stepDays;
  const std::int64_t last = dividedUp(length, stride) - 1; // of the days that are looked at
  return last * dividedUp(kDay, step) + dividedUp(std::min(kDay, length - last * stride), step);
}

std::vector<SunStep> sunSteps(const SunHours& asked) {
  const Span span = spanOf(asked);
  const std::int64_t step = stepOf(asked), stride = kDay * asked.stepDays;
  std::vector<SunStep> steps;
  for (std::int64_t day = 0; day < span.length; day += stride) {
    const std::int64_t end = std::min(day + kDay, span.length);
    const double days = asked.stepDays == 1 ? 1 : static_cast<double>(std::min(stride, span.length - day)) / kDay;
    for (std::int64_t from = day; from < end; from += step) {
      const std::int64_t to = std::min(from + step, end);
      const Moment middle{span.begin.milliseconds + (from + to) / 2, span.begin.zoneMinutes};
      const Sun sun = settledSun({.latitudeDegrees = asked.latitudeDegrees,
                                  .longitudeDegrees = asked.longitudeDegrees,
                                  .time = momentText(middle),
                                  .northDegrees = asked.northDegrees});
      if (*sun.elevationDegrees > 0) steps.push_back({sun, static_cast<double>(to - from) / kHour * days});
    }
  }
  return steps;
}

void appendSunHoursRules(const FrameSpec& spec, std::vector<BrokenRule>& broken) {
  const bool shown = std::find(spec.views.begin(), spec.views.end(), View::sunHours) != spec.views.end();
  if (shown && !spec.sunHours) {
    broken.push_back({invalidValue("/sunHours", "The view sunHours needs a place and a time.",
                                   "latitudeDegrees, longitudeDegrees, begin and end", "absent"),
                      {"/views", "/sunHours"}});
  }
  if (!spec.sunHours) return;
  const SunHours& asked = *spec.sunHours;
  const std::size_t before = broken.size();
  const auto require = [&](bool given, const std::string& pointer) {
    if (!given) broken.push_back({invalidValue(pointer, "Hours of sun need a place.", "", "absent"), {pointer}});
  };
  require(asked.latitudeDegrees.has_value(), "/sunHours/latitudeDegrees");
  require(asked.longitudeDegrees.has_value(), "/sunHours/longitudeDegrees");
  appendTimeRule(asked.begin, "/sunHours/begin", broken);
  appendTimeRule(asked.end, "/sunHours/end", broken);
  if (broken.size() == before) appendSpanRules(asked, broken);
}

} // namespace gnomon
