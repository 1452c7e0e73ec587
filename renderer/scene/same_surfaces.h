#pragma once

#include "renderer/scene/scene.h"

/// Whether what was made of one scene serves another one. Decided by contents (Primitive::content) and by the images
/// that they share; where a content is not known, nothing is shared but by a scene and its poses.
namespace gnomon {

/// Their vertices, attributes and indices are the same.
bool sameMeshes(const Scene& a, const Scene& b);

/// Each material reads the same images by the same samplers, wherever on them.
bool sameTextures(const Scene& a, const Scene& b);

/// Only cameras, lights, names, animations and volumes may differ: every surface is the same in the same place.
bool sameSurfaces(const Scene& a, const Scene& b);

} // namespace gnomon
