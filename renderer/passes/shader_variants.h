#pragma once

#include <set>

#include "protocol/spec/output_options.h"
#include "protocol/spec/shadow_options.h"
#include "renderer/gl/program.h"
#include "renderer/scene/scene.h"
#include "renderer/shaders/shared/frame_types.h"

namespace gnomon {

/// The #defines that a material with alpha needs where only its outline matters; none for an opaque one (null).
std::vector<std::string> maskDefines(const Material* material);

/// Draws depth alone with a vertex shader; `masked` as in maskDefines.
gl::ProgramSource depthProgram(std::string vertexShader, const Material* masked);

/// Draws casters into a tile; `masked` as in maskDefines.
gl::ProgramSource castProgram(const Material* masked, BlendedCasters blended);

/// The same, and the index of each one's node as a color.
gl::ProgramSource casterNodeProgram(const Material* masked, BlendedCasters blended);

struct SurfaceVariant {
  bool tangents = false; ///< the primitive brings its own
  bool emission =
      false; ///< something in the scene glows, lets light through or is unlit: every program writes what it gives off
  bool receiverGroups = false; ///< some light tells receiver groups apart
  bool numbered = false;       ///< says which triangle shows (prepare/draw_list.h)
  bool smoothPlaces = false;   ///< says where the surface lies that shading shows (shaders/shared/smooth_surface.h)
  int bakedLights = 0;         ///< whose light maps are read, 0 to GNOMON_LIGHT_MAPS
  int shownSamples = 0;        ///< of a pixel, where depth says which of them show a triangle; else 0
  bool environment = false;    ///< the scene stands in one, not in the studio
};

/// Draws a material's surface.
gl::ProgramSource surfaceProgram(const Material& material, const SurfaceVariant& variant);

/// How a frame's shadows are looked up.
struct ShadowSampling {
  std::set<int> kinds{};   ///< GNOMON_FILTER_...; none = nothing casts a shadow
  std::set<int> texels{};  ///< sides of the kernels that compare texels
  bool moments = false;    ///< some light's filter reads moments
  bool manualBias = false; ///< of some light
  int atlasSamples = 1;
};

/// What lighting the surfaces needs, and no more.
struct ViewVariant {
  View view = View::color;
  bool encoded = true;         ///< for an 8-bit picture: tone mapped, normals and depths brought into 0..1
  int tone = GNOMON_TONE_NONE; ///< toneOf
  int samples = 1;             ///< a pixel
  bool emission = false;       ///< as in SurfaceVariant
  bool unlit = false;          ///< some material is; `emission` is set then
  bool receiverGroups = false; ///< as in SurfaceVariant
  int lights = 0;
  bool lightLists = false; ///< each square of the picture lists its own
  int tiles = 0;           ///< of the light that has most
  bool punctual = false;   ///< some light is a spot or a point
  ShadowSampling shadows{};
  bool smoothPlaces = false;      ///< as in SurfaceVariant: some light asks for them
  bool visibilityLayers = false;  ///< rays or shadow volumes serve some light, or there is volumeLight
  int bakedLights = 0;            ///< as in SurfaceVariant
  int firstBaked = 0;             ///< the visibility layer of the first of them
  bool shadowColor = false;       ///< some light's shadow is not black
  bool volumes = false;           ///< clouds and the like are seen
  int volumeLight = -1;           ///< the light that they shade surfaces from: a layer of its own, the last; -1 = none
  bool environment = false;       ///< as in SurfaceVariant
  bool shownSurroundings = false; ///< they are the background
};

/// Makes a view from the surfaces.
gl::ProgramSource viewProgram(const ViewVariant& variant);

/// Asks single points for their light; of `variant` what concerns lights and shadows counts.
gl::ProgramSource probeProgram(const ViewVariant& variant);

/// Asks every pixel what the map of one light does to an edge there; `variant` as in probeProgram.
gl::ProgramSource displacementProgram(const ViewVariant& variant);

} // namespace gnomon
