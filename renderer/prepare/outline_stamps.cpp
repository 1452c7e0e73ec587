#include "renderer/prepare/outline_stamps.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon {
namespace {

/// How near to a cell what passes marks it, texels: rounding of the places that are looked up.
constexpr double kReach = 0.02;

/// Texels that an edge is followed at once.
constexpr double kStep = 0.5;

/// Of a clip-space w: what lies behind the light, or in it, is cut off here.
constexpr double kLeastW = 1e-30;

/// The part of a..b where `distance` (of a, of b) is not negative.
struct Part {
  glm::dvec4 a, b;
};
std::optional<Part> cut(const Part& part, double atA, double atB) {
  if (atA < 0 && atB < 0) return std::nullopt;
  const auto between = [&] { return part.a + (part.b - part.a) * (atA / (atA - atB)); };
  if (atA < 0) return Part{between(), part.b};
  if (atB < 0) return Part{part.a, between()};
  return part;
}

} // namespace

Stamps::Stamps(int width, int height)
    : width_(width), height_(height), cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Stamps::fill(const Span& box) {
  const bool somewhere = box.lowest.x <= box.highest.x && box.lowest.y <= box.highest.y;
  if (!somewhere) return; // not a number: nothing is drawn there
  // Cell i runs from i + 0.5 to i + 1.5.
  const auto cellAt = [](double place) { return static_cast<int>(std::floor(std::clamp(place, -1e6, 1e6) - 0.5)); };
  const auto first = [&](double low) { return cellAt(low - kReach); };
  const auto last = [&](double high) { return cellAt(high + kReach); };
  const int left = std::max(first(box.lowest.x), 0);
  const int right = std::min(last(box.highest.x), width_ - 1);
  if (right < left) return;
  const int top = std::min(last(box.highest.y), height_ - 1);
  for (int y = std::max(first(box.lowest.y), 0); y <= top; ++y) {
    const auto row = cells_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
    std::fill(row + left, row + right + 1, std::uint8_t{255});
  }
}

void Stamps::stampEdge(const glm::dvec4& from, const glm::dvec4& to) {
  // Cut to the tile and what reaches into it, before the division, so that nothing large is left.
  const double wide = 1.0 + 4.0 / width_;
  const double high = 1.0 + 4.0 / height_;
  std::optional<Part> part = cut({from, to}, from.w - kLeastW, to.w - kLeastW);
  const auto cutBy = [&](auto distance) {
    if (part) part = cut(*part, distance(part->a), distance(part->b));
  };
  cutBy([&](const glm::dvec4& p) { return wide * p.w - p.x; });
  cutBy([&](const glm::dvec4& p) { return wide * p.w + p.x; });
  cutBy([&](const glm::dvec4& p) { return high * p.w - p.y; });
  cutBy([&](const glm::dvec4& p) { return high * p.w + p.y; });
  if (!part) return;

  const auto texel = [&](const glm::dvec4& p) {
    return (glm::dvec2(p) / p.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
  };
  const glm::dvec2 a = texel(part->a);
  const glm::dvec2 step = texel(part->b) - a;
  const double length = std::max(std::abs(step.x), std::abs(step.y));
  if (!(length < 1e6)) return; // not a number: no such edge is drawn
  const int steps = std::max(1, static_cast<int>(std::ceil(length / kStep)));
  for (int i = 0; i < steps; ++i) {
    const glm::dvec2 p = a + step * (static_cast<double>(i) / steps);
    const glm::dvec2 q = a + step * (static_cast<double>(i + 1) / steps);
    fill({glm::min(p, q), glm::max(p, q)});
  }
}

void Stamps::stampTriangle(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) {
  if (a.w <= kLeastW && b.w <= kLeastW && c.w <= kLeastW) return;
  if (a.w <= kLeastW || b.w <= kLeastW || c.w <= kLeastW) {
    fill({glm::dvec2(0.0), glm::dvec2(width_, height_)}); // it reaches behind the light: anywhere
    return;
  }
  const auto texel = [&](const glm::dvec4& p) {
    return (glm::dvec2(p) / p.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
  };
  const glm::dvec2 ta = texel(a);
  const glm::dvec2 tb = texel(b);
  const glm::dvec2 tc = texel(c);
  fill({glm::min(glm::min(ta, tb), tc), glm::max(glm::max(ta, tb), tc)});
}

} // namespace gnomon
