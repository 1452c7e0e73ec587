#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/replies.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// What a problem with a node's name says there is: names in the file's order.
std::string nodeNames(const Scene& scene);

/// The problem of an index that no node has.
Problem noNodeOfIndex(int index, const Scene& scene, std::string pointer);

/// Finds nodes of a file as requests name them. The scene outlives it.
class NodeFinder {
 public:
  explicit NodeFinder(const Scene& scene) : scene_(scene) {}

  /// The node of that index, or all of that name; at least one. A problem at `pointer` where there is none.
  Result<std::vector<std::size_t>> find(const std::variant<int, std::string>& node, const std::string& pointer);

 private:
  const Scene& scene_;
  std::optional<std::unordered_multimap<std::string_view, std::size_t>> byName_; ///< made by the first name
};

/// A page of the file's nodes. It ends early where their names are long.
NodeList nodesOf(const Scene& scene, const NodePage& page);

} // namespace gnomon
