#include <string>

#include "protocol/spec/validate.h"
#include "protocol/sun/moment.h"

namespace gnomon {

void appendSunRules(const Sun& sun, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const std::vector<std::string> place = {pointer + "/latitudeDegrees", pointer + "/longitudeDegrees",
                                          pointer + "/time"};
  const bool given[] = {sun.latitudeDegrees.has_value(), sun.longitudeDegrees.has_value(), sun.time.has_value()};
  const bool any = given[0] || given[1] || given[2];
  for (std::size_t i = 0; any && i < place.size(); ++i) {
    if (given[i]) continue;
    broken.push_back({invalidValue(place[i], "A sun by place and time needs latitude, longitude and time.",
                                   "latitudeDegrees, longitudeDegrees and time", "absent"),
                      place});
  }
  const auto forbid = [&](bool isGiven, const char* name, const char* detail) {
    if (isGiven) broken.push_back({invalidValue(pointer + name, detail), {pointer + name}});
  };
  const char* const kEither = "A sun has azimuth and elevation, or a place and a time.";
  forbid(any && sun.azimuthDegrees, "/azimuthDegrees", kEither);
  forbid(any && sun.elevationDegrees, "/elevationDegrees", kEither);
  forbid(!any && sun.northDegrees, "/northDegrees", "North is of use to a sun by place and time alone.");
  if (!sun.time) return;
  const auto moment = readMoment(*sun.time);
  if (moment) return;
  Problem problem = moment.problems().front();
  problem.pointer = pointer + "/time";
  broken.push_back({problem, {pointer + "/time"}});
}

} // namespace gnomon
