#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "tests/support/glb_builder.h"

namespace gnomon::bench {

/// Where a sheet's texture coordinates, 0..1 each, lie in space.
using SheetPlace = std::function<glm::vec3(glm::vec2)>;

/// Curved surfaces that become one mesh.
class Sheets {
 public:
  /// `across` x `up` squares. The front is where the place's two directions turn counter-clockwise. `repeat`: how often
  /// the texture fits.
  void add(const SheetPlace& place, int across, int up, const glm::vec2& repeat);

  void addTo(testing::GlbBuilder& glb, int material) const;

 private:
  std::vector<testing::Point> positions_, normals_;
  std::vector<float> texCoords_;
  std::vector<std::uint32_t> indices_;
};

void addSheet(testing::GlbBuilder& glb, int material, const SheetPlace& place, int across, int up,
              const glm::vec2& repeat);

/// A body around the y axis of `foot`, from there `height` metres up; `radius`: at a place of the sheet.
SheetPlace turned(const glm::vec3& foot, float height, const std::function<float(glm::vec2)>& radius);

} // namespace gnomon::bench
