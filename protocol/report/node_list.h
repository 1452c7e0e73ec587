#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Rows of the fields: node_rows.h.
namespace gnomon {

/// A node of the file, whichever of its scenes it belongs to.
struct NodeSummary {
  int node = 0;
  std::string name{};
  std::optional<int> parent{};
  std::uint64_t triangles = 0;
};

/// Which part of the nodes is asked for.
struct NodePage {
  int after = -1;
  int limit = 1000;
};

inline constexpr int kMostNodesOnPage = 10'000;

/// GET /v1/scenes/{id}/nodes: one page, ascending by index.
struct NodeList {
  std::vector<NodeSummary> nodes{};
  std::optional<int> next{};
};

} // namespace gnomon
