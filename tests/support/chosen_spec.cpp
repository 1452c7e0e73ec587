#include "tests/support/chosen_spec.h"

#include <algorithm>

namespace gnomon::testing {
namespace {

using nlohmann::json;

/// A point within `reach` scales of the scene's centre.
json place(Choices& choices, const ChosenScene& scene, double reach) {
  json point;
  for (const double centre : scene.centre) point.push_back(centre + scene.scale * choices.within(reach, -reach));
  return point;
}

json chosenCamera(Choices& choices, const ChosenScene& scene) {
  const double metres = scene.scale;
  json camera = json::object();
  switch (choices.below(6)) {
    case 1:
      camera["orbit"] = {{"azimuthDegrees", choices.within(210, -30)}, {"elevationDegrees", choices.within(20, 85)}};
      break;
    case 2:
      camera["orbit"] = {{"target", scene.centre},
                         {"azimuthDegrees", choices.within(30, 390)},
                         {"elevationDegrees", choices.within(10, 80)},
                         {"distance", metres * choices.factor(8, 1)}};
      break;
    case 3:
      camera["orbit"] = {{"elevationDegrees", choices.of({90, -40})}};
      break;
    case 4:
      camera = {{"eye", place(choices, scene, 5)}, {"target", scene.centre}};
      camera["eye"][1] = scene.centre[1] + metres * choices.within(4, -1);
      break;
    default:
      break;
  }
  switch (choices.below(6)) {
    case 1:
      camera["perspective"] = {{"fovYDegrees", choices.within(45, 140)}};
      break;
    case 2:
      camera["perspective"] = {{"near", metres * choices.factor(1, 1e-3)}};
      break;
    case 3:
      camera["perspective"] = {{"near", metres * 0.1}, {"far", metres * choices.within(60, 5)}};
      break;
    case 4:
      camera["orthographic"] = {{"height", metres * choices.within(12, 2)},
                                {"near", metres * choices.within(0, -5)},
                                {"far", metres * choices.within(80, 10)}};
      break;
    default:
      break;
  }
  return camera;
}

json chosenFilter(Choices& choices, double metres) {
  json filter = {{"type", choices.of({"pcf", "hard", "vsm", "evsm", "msm", "pcss"})}};
  if (filter["type"] != "hard" && filter["type"] != "pcss" && choices.oneIn(4)) {
    filter["radius"] = metres * choices.factor(0.05, 0.005);
  } else if (choices.oneIn(2)) {
    filter["size"] = choices.of({3, 5, 7});
  }
  return filter;
}

json chosenDepthRange(Choices& choices, double metres) {
  switch (choices.below(6)) {
    case 4:
      return {{"mode", "manual"}, {"min", metres * choices.within(0, 3)}, {"max", metres * choices.within(20, 4)}};
    case 5:
      return {{"previous", {{"near", metres * choices.within(0.5, 4)}, {"far", metres * choices.within(40, 5)}}},
              {"guardDistance", metres * choices.within(2, 0)}};
    default:
      return json::object();
  }
}

json chosenShadow(Choices& choices, double metres) {
  json shadow = {{"technique", choices.of({"shadowMap", "shadowMap", "rayTraced"})},
                 {"filter", chosenFilter(choices, metres)},
                 {"depthRange", chosenDepthRange(choices, metres)},
                 {"raySamples", 1 + choices.below(4)}};
  if (choices.oneIn(16)) shadow["technique"] = "shadowVolume";
  if (choices.oneIn(16)) shadow["enabled"] = false;
  if (choices.oneIn(4)) shadow["strength"] = choices.within(1, 0);
  if (choices.oneIn(3)) shadow["size"] = choices.of({"Large", "Medium", "Small", "XSmall", "XLarge"});
  if (choices.oneIn(4)) shadow["importance"] = choices.of({"high", "medium", "low"});
  if (choices.oneIn(2)) shadow["cascadeCount"] = 1 + choices.below(8);
  const int cascades = shadow.value("cascadeCount", 4);
  switch (choices.below(6)) {
    case 3:
      shadow["partition"] = {{"mode", "uniform"}};
      break;
    case 4:
      shadow["partition"] = {{"pssmFactor", choices.within(0.5, 0)}};
      break;
    case 5:
      shadow["partition"] = {{"mode", "manual"}, {"splits", json::array()}};
      for (int i = 1; i <= cascades; ++i) shadow["partition"]["splits"].push_back(1.0 * i / cascades);
      break;
    default:
      break;
  }
  if (choices.oneIn(3)) shadow["stabilization"] = choices.of({"projectionSnapping", "viewSnapping"});
  if (choices.oneIn(3)) shadow["blendCascades"] = false;
  if (choices.oneIn(4)) {
    shadow["bias"] = {{"mode", "manual"},
                      {"depth", metres * choices.within(0.02, 0)},
                      {"slope", metres * choices.within(0.02, 0)},
                      {"normalOffsetScale", choices.within(1, 0)}};
  }
  if (choices.oneIn(3)) shadow["blendedCasters"] = "threshold";
  if (choices.oneIn(3)) shadow["terminator"] = "flat";
  return shadow;
}

json chosenLight(Choices& choices, const ChosenScene& scene) {
  const double metres = scene.scale;
  const char* type = choices.of({"directional", "directional", "spot", "point"});
  json light = {{"type", type}};
  if (light["type"] == "directional") {
    light["sun"] = {{"azimuthDegrees", choices.within(135, -200)}, {"elevationDegrees", choices.within(45, -30)}};
    if (choices.oneIn(8)) light["sun"]["elevationDegrees"] = choices.of({90, 0, -90});
    if (choices.oneIn(4)) light["angularDiameterDegrees"] = choices.within(0.5, 10);
    light["intensity"] = choices.within(3, 0);
  } else {
    light["position"] = place(choices, scene, 5);
    light["intensity"] = metres * metres * choices.within(60, 0);
    if (choices.oneIn(3)) light["range"] = metres * choices.within(10, 0.5);
    if (choices.oneIn(4)) light["radius"] = metres * choices.within(0.2, 0);
  }
  if (light["type"] == "spot") {
    light["direction"] = {choices.within(0, 1), -1, choices.within(0, -1)};
    light["outerConeDegrees"] = choices.within(45, 89);
    light["innerConeDegrees"] = choices.within(0, 40);
  }
  if (choices.oneIn(4)) light["cullingMask"] = 1 + choices.below(3);
  if (choices.oneIn(2)) light["shadow"] = chosenShadow(choices, metres);
  return light;
}

json chosenNodes(Choices& choices, const ChosenScene& scene) {
  json nodes = json::array();
  const int count = choices.of({0, 0, 1, 2});
  for (int i = 0; i < count; ++i) {
    json node = {{"node", choices.below(scene.nodes)}};
    if (choices.oneIn(4)) node["visible"] = false;
    if (choices.oneIn(3)) node["castShadow"] = choices.oneIn(2);
    if (choices.oneIn(3)) node["receiveShadow"] = false;
    if (choices.oneIn(3)) node["layers"] = 1 + choices.below(3);
    nodes.push_back(node);
  }
  return nodes;
}

constexpr std::array kViews{"color",       "color",     "cascades", "shadow",    "texelGrid",   "lightContribution",
                            "depth",       "normal",    "atlas",    "tile",      "bias",        "texelDensity",
                            "blendWeight", "casterIds", "error",    "reference", "edgeDistance"};

} // namespace

json chosenSpec(Choices& choices, const ChosenScene& scene) {
  json spec = {{"width", choices.oneIn(4) ? 1 + choices.below(64) : 64},
               {"height", choices.oneIn(4) ? 1 + choices.below(48) : 48},
               {"camera", chosenCamera(choices, scene)},
               {"shadow", chosenShadow(choices, scene.scale)},
               {"antialiasing", choices.of({"none", "msaa4x"})},
               {"nodes", chosenNodes(choices, scene)},
               {"atlas", {{"size", 512}, {"baseSize", choices.of({128, 256})}}}};
  if (choices.oneIn(8)) spec["atlas"]["samples"] = 4;
  const int lights = choices.below(4);
  if (lights > 0) spec["lights"] = json::array();
  for (int i = 0; i < lights; ++i) spec["lights"].push_back(chosenLight(choices, scene));
  spec["views"] = json::array({kViews[static_cast<std::size_t>(choices.below(static_cast<int>(kViews.size())))]});
  if (choices.oneIn(2)) {
    const char* second = kViews[static_cast<std::size_t>(choices.below(static_cast<int>(kViews.size())))];
    if (spec["views"][0] != second) spec["views"].push_back(second);
  }
  if (choices.oneIn(2)) spec["output"] = {{"format", "exr"}, {"exrPixelType", "float"}};
  if (choices.oneIn(4) && lights > 0) spec["debug"] = {{"light", choices.below(lights)}, {"tile", choices.below(3)}};
  if (choices.oneIn(8)) spec["debug"]["predictEdges"] = true;
  if (choices.oneIn(8)) spec["shadowLightPolicy"] = "first";
  if (choices.oneIn(4)) spec["background"] = {{"alpha", choices.within(1, 0)}};
  if (choices.oneIn(4)) spec["ambient"] = {{"intensity", choices.within(0.3, 2)}};
  if (choices.oneIn(4)) spec["exposure"] = choices.within(0, 2);
  if (choices.oneIn(4)) spec["toneMapping"] = choices.of({"neutral", "agx", "none"});
  return spec;
}

ChosenFrame chosenFrame(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kSpecBytes = 256;
  const std::size_t first = std::min(kSpecBytes, bytes.size());
  Choices ofScene(bytes.subspan(first));
  Choices ofSpec(bytes.first(first));
  const ChosenScene scene = chosenScene(ofScene);
  return {scene.builder.glb(), chosenSpec(ofSpec, scene)};
}

} // namespace gnomon::testing
