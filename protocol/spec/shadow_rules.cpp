#include "protocol/fields/field_checks.h"
#include "protocol/spec/traits.h"
#include "protocol/spec/validate.h"

namespace gnomon {
namespace {

void appendPartitionRules(const Shadow& shadow, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const Partition& partition = shadow.partition;
  const std::string splits = pointer + "/partition/splits";
  const std::string mode = pointer + "/partition/mode";
  if (partition.mode != PartitionMode::manual) {
    if (partition.splits.empty()) return;
    broken.push_back({invalidValue(splits, "A list of splits needs partition mode manual.", "",
                                   "mode " + std::string(spell(partition.mode))),
                      {mode}});
    return;
  }
  if (partition.splits.size() != static_cast<std::size_t>(shadow.cascadeCount)) {
    broken.push_back({invalidValue(splits, "Partition mode manual needs one split for each cascade.",
                                   std::to_string(shadow.cascadeCount), std::to_string(partition.splits.size())),
                      {mode, splits, pointer + "/cascadeCount"}});
  }
  for (std::size_t i = 1; i < partition.splits.size(); ++i) {
    if (partition.splits[i] > partition.splits[i - 1]) continue;
    broken.push_back({invalidValue(splits + "/" + std::to_string(i), "Each split must be more than the one before.",
                                   "more than " + numberText(partition.splits[i - 1]), numberText(partition.splits[i])),
                      {mode, splits}});
  }
}

void appendDepthRangeRules(const DepthRange& range, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const std::string mode = pointer + "/mode";
  const std::string min = pointer + "/min";
  const std::string max = pointer + "/max";
  const bool manual = range.mode == DepthRangeMode::manual;
  for (const auto& [value, place] : {std::pair(range.min, min), std::pair(range.max, max)}) {
    if (value.has_value() == manual) continue;
    broken.push_back({invalidValue(place,
                                   manual ? "Mode manual of depthRange needs min and max."
                                          : "Only mode manual of depthRange has min and max.",
                                   "", manual ? "absent" : "mode automatic"),
                      {mode, place}});
  }
  if (manual && range.min && range.max && *range.min >= *range.max) {
    broken.push_back({invalidValue(max, "The value of max must be more than min.",
                                   "more than " + numberText(*range.min), numberText(*range.max)),
                      {mode, min, max}});
  }
}

void appendPreviousRangeRules(const DepthRange& range, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const std::string previous = pointer + "/previous";
  if (range.guardDistance && !range.previous) {
    broken.push_back({invalidValue(pointer + "/guardDistance", "A guardDistance needs a previous range."), {previous}});
  }
  if (!range.previous) return;
  if (range.mode == DepthRangeMode::manual) {
    broken.push_back({invalidValue(previous, "A previous range needs depthRange mode automatic.", "", "mode manual"),
                      {pointer + "/mode"}});
  }
  if (range.previous->near >= range.previous->far) {
    broken.push_back({invalidValue(previous + "/far", "The value of far must be more than near.",
                                   "more than " + numberText(range.previous->near), numberText(range.previous->far)),
                      {previous}});
  }
}

void appendFilterRules(const Filter& filter, const std::string& pointer, std::vector<BrokenRule>& broken) {
  if (!filter.radius || (filter.type != FilterType::hard && filter.type != FilterType::pcss)) return;
  const bool hard = filter.type == FilterType::hard;
  broken.push_back({invalidValue(pointer + "/radius",
                                 hard ? "A hard shadow has no radius."
                                      : "Filter pcss is as soft as the light's own size: angularDiameterDegrees or "
                                        "radius of the light.",
                                 "filter type pcf, vsm, evsm or msm", std::string(spell(filter.type))),
                    {pointer + "/type"}});
}

void appendBiasRules(const Bias& bias, const std::string& pointer, std::vector<BrokenRule>& broken) {
  if (bias.mode == BiasMode::manual) return;
  for (const auto& [value, name] : {std::pair(bias.depth, "depth"), std::pair(bias.slope, "slope"),
                                    std::pair(bias.normalOffsetScale, "normalOffsetScale")}) {
    if (!value) continue;
    broken.push_back(
        {invalidValue(pointer + "/" + name, "The bias value " + std::string(name) + " needs bias mode manual.", "",
                      "mode automatic"),
         {pointer + "/mode"}});
  }
}

} // namespace

int tileSide(ShadowSize size, const Atlas& atlas) {
  constexpr int kLarge = static_cast<int>(ShadowSize::Large);
  const int steps = static_cast<int>(size) - kLarge;
  return steps >= 0 ? atlas.baseSize << steps : atlas.baseSize >> -steps;
}

void appendAtlasRules(const Atlas& atlas, std::vector<BrokenRule>& broken) {
  if (atlas.baseSize <= atlas.size) return;
  broken.push_back({invalidValue("/atlas/baseSize", "The baseSize of a tile can't be more than the atlas's size.",
                                 "at most " + std::to_string(atlas.size), std::to_string(atlas.baseSize)),
                    {"/atlas/size", "/atlas/baseSize"}});
}

void appendShadowRules(const Shadow& shadow, const Atlas& atlas, const std::string& pointer,
                       std::vector<BrokenRule>& broken) {
  appendPartitionRules(shadow, pointer, broken);
  appendDepthRangeRules(shadow.depthRange, pointer + "/depthRange", broken);
  appendPreviousRangeRules(shadow.depthRange, pointer + "/depthRange", broken);
  appendFilterRules(shadow.filter, pointer + "/filter", broken);
  appendBiasRules(shadow.bias, pointer + "/bias", broken);
  const int side = tileSide(shadow.size.value_or(ShadowSize::Large), atlas);
  if (side > atlas.size && atlas.baseSize <= atlas.size) {
    broken.push_back(
        {invalidValue(pointer + "/size", "One tile of this size is larger than the atlas.",
                      "at most " + std::to_string(atlas.size) + " texels", std::to_string(side) + " texels"),
         {pointer + "/size", "/atlas/size", "/atlas/baseSize"}});
  }
}

} // namespace gnomon
