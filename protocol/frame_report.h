#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/frame_spec.h"

namespace gnomon {

/// One stage's time. Names and order: queue load upload survey plan shadow shade readback encode.
struct StageTime {
  std::string stage{};
  double milliseconds = 0;
};

/// One tile as it was drawn: a cascade, or a face of a spot or point light.
struct CascadeReport {
  double near = 0;                   ///< metres: view depth where it begins; face: distance along its direction
  double far = 0;                    ///< metres: where it ends
  std::array<int, 4> tile{};         ///< x y width height in the atlas, texels, border included
  std::array<double, 2> texelSize{}; ///< metres across and along; of a face: at its far end
  std::uint64_t casterTriangles = 0; ///< drawn into this tile
  std::uint64_t culledTriangles = 0; ///< not drawn: they can't shadow anything that this cascade serves
  bool reused = false;               ///< drawn for an earlier frame; nothing was drawn for this one
};

struct LightReport {
  int light = 0; ///< index into the effective spec's lights
  bool shadowed = false;
  int askedTileSize = 0;   ///< texels; 0 = no shadow was asked for
  int grantedTileSize = 0; ///< texels; 0 = none
  std::string note{};      ///< why no shadow was drawn, or what was decided differently; empty = as asked
  std::vector<CascadeReport> cascades{};
};

struct FrameCounts {
  std::uint64_t sceneTriangles = 0;    ///< in the chosen glTF scene
  std::uint64_t surveyedTriangles = 0; ///< drawn by the survey: inside the view
  std::uint64_t shadedTriangles = 0;   ///< drawn for the surfaces to light: in clusters that the survey saw
  std::uint64_t casterTriangles = 0;   ///< drawn into all tiles
  std::uint64_t drawCalls = 0;
};

/// What a frame's rendering gives besides its pictures.
struct FrameReport {
  FrameSpec spec{};                   ///< effective: every default resolved, so that it can be asked for again
  std::array<double, 2> depthRange{}; ///< nearest and farthest surface in view, metres; 0 0 = nothing in view
  std::array<int, 2> atlasSize{};     ///< texels that the atlas really took; 0 0 = no atlas
  std::vector<LightReport> lights{};
  FrameCounts counts{};
  std::vector<StageTime> stages{};
  std::vector<std::string> warnings{};
};

} // namespace gnomon
