#include "renderer/volume/transmittance.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderer/core/instruction_sets.h"
#include "renderer/volume/extinction_cells.h"

namespace gnomon {

/// From the places of rays to a medium's cells: the border's first one has its middle at 0, 0, 0.
struct CellsFromPlaces {
  glm::dmat3 turn{1};
  glm::dvec3 shift{0};
  glm::vec3 low{0}, high{0}; ///< where anything is, in cells
};

namespace {

constexpr std::size_t kRays = EndlessRays::kCount;

/// The pieces of rays that lie in a medium, in its cells.
struct Pieces {
  alignas(64) float place[3][kRays]; ///< in the middle of the first step
  float step[3][kRays];              ///< from there to the next one's
  float metres[kRays];               ///< of a step
  int steps[kRays];
};

float within(float value, float low, float high) {
  return value > low ? (value < high ? value : high) : low; // low for NaN
}

GNOMON_FOR_EACH_INSTRUCTION_SET void findPieces(CellsFromPlaces to, const EndlessRays& rays, Pieces& pieces) {
  Pieces found; // what nothing else can refer to becomes vectors
  const glm::mat3 turn(to.turn);
  for (std::size_t i = 0; i < kRays; ++i) {
    const glm::dvec3 from = to.turn * glm::dvec3(rays.from[0][i], rays.from[1][i], rays.from[2][i]) + to.shift;
    const glm::vec3 start(from);
    const glm::vec3 toward = turn * glm::vec3(rays.toward[0][i], rays.toward[1][i], rays.toward[2][i]);
    float near = 0, far = 1e30f;
    for (int axis = 0; axis < 3; ++axis) {
      const float along = std::fabs(toward[axis]) < 1e-20f ? 1e-20f : toward[axis];
      const float toLow = (to.low[axis] - start[axis]) / along;
      const float toHigh = (to.high[axis] - start[axis]) / along;
      const float enters = toLow < toHigh ? toLow : toHigh;
      const float leaves = toLow < toHigh ? toHigh : toLow;
      near = near < enters ? enters : near;
      far = leaves < far ? leaves : far;
    }
    const bool passes = rays.asked[i] != 0 && near < far;
    const float length = passes ? far - near : 0.0f;
    const float cells = length * std::sqrt(glm::dot(toward, toward));
    const float steps = passes ? static_cast<float>(static_cast<int>(within(cells, 0, 1000))) + 1 : 0.0f;
    const float metres = passes ? length / steps : 0.0f;
    const float first = passes ? near + 0.5f * metres : 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      found.place[axis][i] = start[axis] + first * toward[axis];
      found.step[axis][i] = metres * toward[axis];
    }
    found.metres[i] = metres;
    found.steps[i] = static_cast<int>(steps);
  }
  pieces = found;
}

/// `size`: of the cells without their border.
GNOMON_FOR_EACH_INSTRUCTION_SET void addUp(const Pieces& of, const float* perMetre, glm::ivec3 size, int most,
                                           float (&depths)[kRays]) {
  Pieces pieces = of;
  alignas(64) float sums[kRays] = {};
  const int row = size.x + 2;
  const int layer = row * (size.y + 2);
  const glm::vec3 last = glm::vec3(size) + 0.5f;
  for (int step = 0; step < most; ++step) {
    const auto steps = static_cast<float>(step);
    for (std::size_t i = 0; i < kRays; ++i) {
      const float x = within(pieces.place[0][i] + steps * pieces.step[0][i], 0.5f, last.x);
      const float y = within(pieces.place[1][i] + steps * pieces.step[1][i], 0.5f, last.y);
      const float z = within(pieces.place[2][i] + steps * pieces.step[2][i], 0.5f, last.z);
      const auto lowX = static_cast<int>(x);
      const auto lowY = static_cast<int>(y);
      const auto lowZ = static_cast<int>(z);
      const float shareX = x - static_cast<float>(lowX);
      const float shareY = y - static_cast<float>(lowY);
      const float shareZ = z - static_cast<float>(lowZ);
      const int at = lowZ * layer + lowY * row + lowX;
      const int above = at + layer;
      const float a = perMetre[at] + shareX * (perMetre[at + 1] - perMetre[at]);
      const float b = perMetre[at + row] + shareX * (perMetre[at + row + 1] - perMetre[at + row]);
      const float c = perMetre[above] + shareX * (perMetre[above + 1] - perMetre[above]);
      const float d = perMetre[above + row] + shareX * (perMetre[above + row + 1] - perMetre[above + row]);
      const float low = a + shareY * (b - a);
      const float high = c + shareY * (d - c);
      const float found = low + shareZ * (high - low);
      sums[i] += step < pieces.steps[i] ? found * pieces.metres[i] : 0.0f;
    }
  }
  for (std::size_t i = 0; i < kRays; ++i) depths[i] += sums[i];
}

} // namespace

struct Transmittance::Part {
  std::shared_ptr<const ExtinctionCells> cells;
  CellsFromPlaces to;
};

Transmittance::Transmittance(std::span<const Medium* const> media, const glm::dvec3& origin) {
  for (const Medium* medium : media) {
    const ExtinctionCells& cells = *medium->cells;
    if (!medium->castShadow || cells.low == cells.high) continue;
    const glm::dvec3 size(cells.size);
    const glm::dmat3 turn = glm::dmat3(size.x, 0, 0, 0, size.y, 0, 0, 0, size.z) * medium->space.inverse;
    parts_.push_back({medium->cells,
                      {turn, turn * (origin - medium->space.corner) + 0.5, cells.low * glm::vec3(size) + 0.5f,
                       cells.high * glm::vec3(size) + 0.5f}});
  }
}
Transmittance::~Transmittance() = default;

bool Transmittance::empty() const {
  return parts_.empty();
}

std::array<float, kRays> Transmittance::along(const EndlessRays& rays) const {
  float depths[kRays] = {};
  for (const Part& part : parts_) {
    Pieces pieces;
    findPieces(part.to, rays, pieces);
    const int most = *std::max_element(std::begin(pieces.steps), std::end(pieces.steps));
    if (most > 0) addUp(pieces, part.cells->perMetre.data(), part.cells->size, most, depths);
  }
  std::array<float, kRays> shares;
  for (std::size_t i = 0; i < kRays; ++i) shares[i] = depths[i] > 0 ? std::exp(-depths[i]) : 1.0f;
  return shares;
}

} // namespace gnomon
