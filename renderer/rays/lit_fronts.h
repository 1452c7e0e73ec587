#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "renderer/rays/light_source.h"
#include "renderer/rays/traced_scene.h"
#include "renderer/rays/triangle_boxes.h"

namespace gnomon {

/// A light and what throws its shadows.
struct LightAndCasters {
  LightSource light;
  std::vector<std::uint8_t> casts; ///< one an instance
  bool smooth = false;             ///< Terminator::smooth
  bool operator==(const LightAndCasters&) const = default;
};

/// What the front of a triangle sees of a light. lit: all of it, from everywhere; dark: nothing, since it is turned
/// away from everywhere, and so is the surface that shading shows there; mixed: neither, or it takes long to find out.
enum class Front : std::uint8_t { unknown, lit, dark, mixed };

/// What the fronts of a run of triangles see, two bits each.
class RunFronts {
 public:
  RunFronts() = default;
  explicit RunFronts(std::uint64_t bits) : bits_(bits) {}

  Front of(std::uint32_t place) const { return static_cast<Front>(bits_ >> 2 * place & 3); }
  void set(std::uint32_t place, Front front) {
    bits_ = (bits_ & ~(std::uint64_t{3} << 2 * place)) | static_cast<std::uint64_t>(front) << 2 * place;
  }
  std::uint64_t bits() const { return bits_; }

 private:
  std::uint64_t bits_ = 0;
};
static_assert(2 * TriangleBoxes::kRunTriangles <= 64);

/// Finds out what they see. None is unknown.
RunFronts frontsOf(const TracedScene::Tree& tree, const LightAndCasters& of, const TriangleBoxes::Run& run);

/// What is known of the fronts of a scene's triangles and one light. Any thread.
class LitFronts {
 public:
  explicit LitFronts(std::size_t runs) : runs_(runs) {}

  RunFronts of(std::size_t run) const { return RunFronts(runs_[run].load(std::memory_order_relaxed)); }
  void set(std::size_t run, const RunFronts& fronts);

  /// False once many runs were found out and few of their fronts are lit: of such a scene the rest is not asked for.
  bool areWorthKnowing() const;

 private:
  std::vector<std::atomic<std::uint64_t>> runs_;
  std::atomic<std::uint64_t> known_ = 0, lit_ = 0, mixed_ = 0; ///< runs; fronts
};

/// What is known of the lights that frames of a scene ask about again and again. Any thread.
class KeptFronts {
 public:
  /// None for a light that is asked about for the first time: it may be one that moves. Those that were not asked about
  /// for the longest time are forgotten.
  std::shared_ptr<LitFronts> of(const LightAndCasters& light, std::size_t runs);

  static std::size_t mostBytes(std::size_t runs, std::size_t instances) {
    return kMostLights * (runs * sizeof(std::uint64_t) + instances);
  }

 private:
  static constexpr std::size_t kMostLights = 16;

  struct Kept {
    LightAndCasters light;
    std::shared_ptr<LitFronts> fronts; ///< none until the light is asked about again
  };
  std::mutex mutex_;
  std::vector<Kept> kept_; ///< the last one asked about is the last
};

} // namespace gnomon
