#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Where a frame puts a node, relative to its parent. What is absent stays as it is.
struct NodePlace {
  std::size_t node = 0;               ///< index into Scene::nodes
  std::size_t entry = 0;              ///< of the frame's nodes: the last that says so
  std::optional<glm::dmat4> matrix{}; ///< instead of the others
  std::optional<glm::dvec3> translation{};
  std::optional<glm::dquat> rotation{}; ///< of length 1
  std::optional<glm::dvec3> scale{};

  bool operator==(const NodePlace&) const = default;
};

/// The places that the entries give, of each node one, ascending by node. Of two entries for one node the later counts,
/// part by part; a matrix and parts replace each other. An entry with a place that finds no node is a problem at
/// /nodes/i/node.
Result<std::vector<NodePlace>> nodePlaces(std::span<const NodeOptions> entries, const Scene& scene);

/// Whether an entry says anything of a place.
bool hasPlace(const NodeOptions& entry);

/// A node's own transform with the place's parts. Parts beside a matrix of the file replace it.
LocalTransform moved(LocalTransform local, const NodePlace& place);

} // namespace gnomon
