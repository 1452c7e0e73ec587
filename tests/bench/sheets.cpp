#include "tests/bench/sheets.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace gnomon::bench {

using glm::vec2;
using glm::vec3;

void Sheets::add(const SheetPlace& place, int across, int up, const vec2& repeat) {
  const auto first = static_cast<std::uint32_t>(positions_.size());
  for (int j = 0; j <= up; ++j) {
    for (int i = 0; i <= across; ++i) {
      const vec2 at = vec2(i, j) / vec2(across, up);
      constexpr float kStep = 1e-3f;
      const vec3 along = place(at + vec2(kStep, 0)) - place(at - vec2(kStep, 0));
      const vec3 aside = place(at + vec2(0, kStep)) - place(at - vec2(0, kStep));
      const vec3 p = place(at), n = glm::normalize(glm::cross(along, aside));
      positions_.push_back({p.x, p.y, p.z});
      normals_.push_back({n.x, n.y, n.z});
      texCoords_.insert(texCoords_.end(), {at.x * repeat.x, at.y * repeat.y});
    }
  }
  const auto row = static_cast<std::uint32_t>(across + 1);
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(up); ++j) {
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(across); ++i) {
      const std::uint32_t a = first + j * row + i, b = a + 1, c = b + row, d = a + row;
      indices_.insert(indices_.end(), {a, b, c, a, c, d});
    }
  }
}

void Sheets::addTo(testing::GlbBuilder& glb, int material) const {
  const int texCoord = glb.addAccessor(texCoords_, "VEC2", 5126, positions_.size());
  glb.addMeshNode(glb.addMesh(
      {{"attributes",
        {{"POSITION", glb.addPoints(positions_)}, {"NORMAL", glb.addPoints(normals_)}, {"TEXCOORD_0", texCoord}}},
       {"indices", glb.addIndices(indices_)},
       {"material", material}}));
}

void addSheet(testing::GlbBuilder& glb, int material, const SheetPlace& place, int across, int up, const vec2& repeat) {
  Sheets sheet;
  sheet.add(place, across, up, repeat);
  sheet.addTo(glb, material);
}

SheetPlace turned(const vec3& foot, float height, const std::function<float(vec2)>& radius) {
  return [=](vec2 at) {
    const float angle = -glm::two_pi<float>() * at.x, r = radius(at);
    return foot + vec3(r * std::cos(angle), height * at.y, r * std::sin(angle));
  };
}

} // namespace gnomon::bench
