#pragma once

#include <gtest/gtest.h>
#include <string>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/support/glb_builder.h"

namespace gnomon::testing {

/// One renderer for all cases of a program: a context is made once.
Renderer& sharedRenderer();

/// Whether a GPU draws its frames: it rounds and rasterizes otherwise than llvmpipe, by whose pictures tests are
/// strict.
bool drawnByGpu();

/// A shadow.filter of every kind and size, as JSON.
const Json& everyFilter();

ScenePtr sceneOf(const GlbBuilder& builder);
ScenePtr sceneOf(Bytes glb);
ScenePtr sceneOf(const SceneBundle& bundle);
ScenePtr generatedScene(const std::string& name); ///< of tests/scenes
Bytes generatedGlb(const std::string& name);

/// The spec with shadow maps where it names no technique: what auto chooses is tested by itself.
Json withMaps(Json spec);

/// Renders a FrameSpec given as JSON, withMaps; a failed expectation and an empty frame when it is refused.
Frame renderJson(const ScenePtr& scene, const std::string& spec);

/// Renders what must be refused; the problems.
Problems refusedJson(const ScenePtr& scene, const std::string& spec);

/// The floats of a view of an EXR frame.
const std::vector<float>& floatsOf(const Frame& frame, std::size_t view = 0);

/// A value of a one-channel view at a place given as shares of the picture, from its upper left corner.
float valueAt(const Frame& frame, double x, double y, std::size_t view = 0);

} // namespace gnomon::testing
