#include "tests/hard_cases/hard_case.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "protocol/spec/enum_rows.h"

namespace gnomon::testing {
namespace {

void setWay(Json& shadow, const Way& way) {
  for (const auto& [key, value] : way.shadow.items()) shadow[key] = value;
}

void move(Json& place, const Json& step, int times) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place[axis] = place[axis].get<double>() + times * step[axis].get<double>();
  }
}

} // namespace

void PrintTo(const HardCase& hard, std::ostream* out) {
  *out << hard.file.at("says").get<std::string>();
}

std::vector<HardCase> hardCases() {
  std::vector<HardCase> cases;
  for (const auto& entry : std::filesystem::directory_iterator(GNOMON_HARD_CASES)) {
    if (entry.path().extension() != ".json") continue;
    cases.push_back({entry.path().stem(), Json::parse(std::ifstream(entry.path()))});
  }
  std::sort(cases.begin(), cases.end(), [](const HardCase& a, const HardCase& b) { return a.name < b.name; });
  return cases;
}

std::vector<Way> everyWay() {
  std::vector<Way> ways;
  for (const Spelling& technique : kSpellings<ShadowTechnique>) {
    if (technique.value == static_cast<int>(ShadowTechnique::auto_)) continue; // is one of the others
    if (technique.value != static_cast<int>(ShadowTechnique::shadowMap)) {
      Json shadow{{"technique", technique.name}};
      if (technique.value == static_cast<int>(ShadowTechnique::shadowVolume))
        shadow["terminator"] = "flat"; // as it does
      ways.push_back({std::string(technique.name), shadow});
      continue;
    }
    for (const char* filter : {"hard", "pcf"}) {
      ways.push_back({filter, {{"technique", technique.name}, {"filter", {{"type", filter}}}}});
    }
  }
  return ways;
}

Json requestOf(const HardCase& hard, const Way& way, const std::vector<std::string>& views) {
  Json request = hard.file.at("spec");
  setWay(request["shadow"], way);
  if (request.contains("lights")) {
    for (Json& light : request["lights"]) {
      if (light.contains("shadow")) setWay(light["shadow"], way);
    }
  }
  if (!request.contains("width")) request["width"] = 320;
  if (!request.contains("height")) request["height"] = 180;
  request["antialiasing"] = "none";
  request["views"] = views;
  request["output"] = {{"format", "exr"}, {"exrPixelType", "float"}};
  return request;
}

std::vector<Json> pathOf(const HardCase& hard, const Json& request) {
  const Json& path = hard.file.at("path");
  std::vector<Json> frames;
  for (int i = 0; i < path.at("frames").get<int>(); ++i) {
    frames.push_back(request);
    move(frames.back()["camera"]["eye"], path.at("eyeStep"), i);
    move(frames.back()["camera"]["target"], path.at("targetStep"), i);
  }
  return frames;
}

} // namespace gnomon::testing
