#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A node of the file, whichever of its scenes it belongs to.
struct NodeSummary {
  int node = 0; ///< index into the file's nodes; usable as nodes[].node
  std::string name{};
  std::optional<int> parent{}; ///< index of the node above it; absent = a root
  std::uint64_t triangles = 0; ///< that the node itself places, in the scene that shows the most of it
};

/// Which part of the nodes is asked for.
struct NodePage {
  int after = -1;   ///< index of the last node that is known already
  int limit = 1000; ///< the most nodes on the page
};

inline constexpr int kMostNodesOnPage = 10'000;

/// GET /v1/scenes/{id}/nodes: one page, ascending by index.
struct NodeList {
  std::vector<NodeSummary> nodes{};
  std::optional<int> next{}; ///< what the next page comes after; absent = this is the last
};

} // namespace gnomon
