#include "renderer/rays/light_source.h"

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "protocol/base/split_mix.h"
#include "renderer/core/instruction_sets.h"
#include "renderer/core/light.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/core/reversed_bits.h"

namespace gnomon {
namespace {

/// The sine of up to an eighth of a turn, by its series to the last bit or two of a double: without branches or calls.
inline double sineOf(double x) {
  const double z = x * x;
  return x * (1 + z * (-1.0 / 6 +
                       z * (1.0 / 120 +
                            z * (-1.0 / 5040 +
                                 z * (1.0 / 362880 +
                                      z * (-1.0 / 39916800 + z * (1.0 / 6227020800 + z * (-1.0 / 1307674368000))))))));
}

inline double cosineOf(double x) {
  const double z = x * x;
  return 1 + z * (-1.0 / 2 +
                  z * (1.0 / 24 +
                       z * (-1.0 / 720 +
                            z * (1.0 / 40320 +
                                 z * (-1.0 / 3628800 + z * (1.0 / 479001600 +
                                                            z * (-1.0 / 87178291200 + z * (1.0 / 20922789888000))))))));
}

/// Area for area from the unit square onto the unit disc (Shirley and Chiu, "A Low Distortion Map Between Disk and
/// Square", Journal of Graphics Tools 1997).
[[gnu::always_inline]] inline glm::dvec2 discFromSquare(double x, double y) {
  const double px = 2 * x - 1;
  const double py = 2 * y - 1;
  const bool wide = std::abs(px) > std::abs(py);
  const double radius = wide ? px : py;
  const double ratio = (wide ? py : px) / (radius == 0 ? 1.0 : radius);
  const double angle = 0.25 * glm::pi<double>() * ratio; // from the x axis where it is wide, else from the y axis
  const double along = radius * cosineOf(angle);
  const double aside = radius * sineOf(angle);
  return {wide ? along : aside, wide ? aside : along};
}

/// In the unit square: Hammersley's points (Niederreiter, "Random Number Generation and Quasi-Monte Carlo Methods",
/// 1992, 3.2): shifted along x, scrambled in y, which leaves one in each of the `count` strips either way.
glm::dvec2 squareSample(std::uint32_t index, std::uint32_t count, std::uint64_t seed) {
  constexpr double kUnit = 1.0 / 4294967296.0;
  if (count == 0) {
    const SquarePlace place = sequencePlace(index);
    return {(static_cast<double>(place.x ^ static_cast<std::uint32_t>(seed >> 32)) + 0.5) * kUnit,
            (static_cast<double>(place.y ^ static_cast<std::uint32_t>(seed)) + 0.5) * kUnit};
  }
  const double shift = static_cast<double>(seed >> 32) * kUnit;
  return {(index + shift) / count,
          (static_cast<double>(reversedBits(index) ^ static_cast<std::uint32_t>(seed)) + 0.5) * kUnit};
}

/// The shift that takes each four rays from a multiple of 4 on to the same places in another order: the first of them
/// to the same quarter of the square whatever the shift was. (Number 1 of the sequence lies in the other half along
/// both axes, number 2 along y alone: `shift` is XORed with one of the first four, and so are the numbers of the rays.)
SquarePlace inFirstQuarter(const SquarePlace& shift) {
  const std::uint32_t right = shift.x >> 31;
  const SquarePlace by = sequencePlace(right | (right ^ shift.y >> 31) << 1);
  return {shift.x ^ by.x, shift.y ^ by.y};
}

} // namespace

LightSource lightSource(const Light& light, const glm::dvec3& anchor) {
  LightSource source;
  source.type = light.type;
  source.axis = directionOf(light);
  source.range = light.range.value_or(HUGE_VAL);
  source.radius = radiusOf(light);
  if (light.position) source.position = toVector(*light.position) - anchor;
  if (traitsOf(light.type).hasCone) source.cosOuter = std::cos(glm::radians(light.outerConeDegrees));
  return source;
}

LightDisc discFacing(const LightSource& light, const glm::dvec3& point) {
  const WayToLight way = wayTo(light, point);
  const glm::dvec3& n = way.direction;
  // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  LightDisc disc;
  disc.across = light.radius * glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  disc.up = light.radius * glm::dvec3(b, sign + n.y * n.y * a, -n.y);
  disc.atInfinity = traitsOf(light.type).parallel;
  disc.middle = disc.atInfinity ? n : light.position - point;
  return disc;
}

namespace {

/// Ways to the places of the disc that these of the unit square become.
GNOMON_FOR_EACH_INSTRUCTION_SET void waysToAll(const LightDisc& disc, const double (&x)[kLanes],
                                               const double (&y)[kLanes], const glm::dvec3& normal, SampleWays& ways) {
  const double infinite = disc.atInfinity ? HUGE_VAL : 0.0;
  for (unsigned i = 0; i < kLanes; ++i) {
    const glm::dvec2 place = discFromSquare(x[i], y[i]);
    const glm::dvec3 offset = disc.middle + disc.across * place.x + disc.up * place.y;
    const double length = std::sqrt(glm::dot(offset, offset));
    const glm::dvec3 direction = offset / (length > 0 ? length : 1.0);
    ways.direction[0][i] = direction.x;
    ways.direction[1][i] = direction.y;
    ways.direction[2][i] = direction.z;
    ways.length[i] = length + infinite;
    ways.cosine[i] = glm::dot(direction, normal);
  }
}

} // namespace

void waysTo(const LightDisc& disc, const LightSamples& samples, std::uint64_t seed, const glm::dvec3& normal,
            SampleWays& ways) {
  double x[kLanes];
  double y[kLanes];
  for (unsigned i = 0; i < kLanes; ++i) {
    const glm::dvec2 square = squareSample(samples.first + i, samples.of, seed);
    x[i] = square.x;
    y[i] = square.y;
  }
  waysToAll(disc, x, y, normal, ways);
}

SquarePlace sequencePlace(std::uint32_t index) {
  SquarePlace place{reversedBits(index), 0};
  // Sobol, "On the distribution of points in a cube", 1967: Pascal's triangle modulo 2.
  for (std::uint32_t column = 1u << 31; index != 0; index >>= 1, column ^= column >> 1) {
    if ((index & 1u) != 0) place.y ^= column;
  }
  // A linear scramble, which keeps rectangles full (Matousek, "On the L2-discrepancy for anchored boxes", Journal of
  // Complexity 1998). The shifts by 2 are those that take the places out of the rows in which a straight edge would
  // meet many at once: it divides 16 of them on the disc as it does the disc, to 0.038 (rms) instead of 0.046.
  return {place.x ^ place.x >> 2, place.y ^ place.y >> 2};
}

Interleaved::Interleaved(std::uint32_t rays) {
  const std::uint32_t own = std::bit_ceil(rays);
  for (std::uint32_t ray = 0; ray < rays; ++ray) places_.push_back(sequencePlace(ray));
  // Each pixel has a block of its own of the sequence, which is even by itself and beside the others. Which of its
  // block comes first, as a matrix of bits, and by what all are shifted: of the matrices that there are and some
  // hundred shifts those whose first rays leave only narrow stripes of the light unseen, in whatever direction.
  constexpr std::uint32_t kColumns[] = {0xb, 0x9, 0x7, 0xf};
  for (std::uint32_t i = 0; i < shifts_.size(); ++i) {
    const std::uint32_t pixel = (i & 1u) | (i & 4u) >> 1 | (i & 2u) << 1 | (i & 8u); // squares of 2 x 2 are even, too
    std::uint32_t first = 0;
    for (std::uint32_t bit = 0; bit < 4; ++bit) first ^= (pixel >> bit & 1u) != 0 ? kColumns[bit] : 0;
    const SquarePlace place = sequencePlace((first & (own - 1)) | pixel * own);
    shifts_[i] = {place.x ^ 0x0c3375c9u, place.y ^ 0xc19953ddu};
    aligned_[i] = inFirstQuarter(shifts_[i]);
  }
}

std::uint64_t seedOf(const SurfacePoint& point) {
  std::uint64_t seed = splitMix64((std::uint64_t{point.instance} << 32) | point.triangle);
  for (int axis = 0; axis < 3; ++axis) seed = splitMix64(seed ^ std::bit_cast<std::uint64_t>(point.position[axis]));
  return seed;
}

} // namespace gnomon
