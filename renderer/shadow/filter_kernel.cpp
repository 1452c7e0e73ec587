#include "renderer/shadow/filter_kernel.h"

#include <array>
#include <cmath>

#include "protocol/spec/enum_rows.h"

namespace gnomon {
namespace {

/// What a filter type is, whatever its size.
struct FilterTraits {
  FilterType type;
  MapReadingKind bySize;   ///< how the map is read where a size in texels is given
  MapReadingKind byRadius; ///< the same for a radius in metres
  bool sized;              ///< size and radius have a meaning
  bool moments;            ///< depths are blurred before they are read
};

constexpr std::array kFilters{
    FilterTraits{FilterType::hard, MapReadingKind::texels, MapReadingKind::texels, false, false},
    FilterTraits{FilterType::pcf, MapReadingKind::texels, MapReadingKind::disc, true, false},
    FilterTraits{FilterType::vsm, MapReadingKind::vsm, MapReadingKind::vsm, true, true},
    FilterTraits{FilterType::evsm, MapReadingKind::evsm, MapReadingKind::evsm, true, true},
    FilterTraits{FilterType::msm, MapReadingKind::msm, MapReadingKind::msm, true, true},
};
static_assert(rowsAreComplete(kFilters, &FilterTraits::type));

} // namespace

FilterKernel kernelOf(const Filter& filter) {
  const FilterTraits& traits = kFilters[static_cast<std::size_t>(filter.type)];
  FilterKernel kernel;
  kernel.moments = traits.moments;
  if (traits.sized && filter.radius) {
    kernel.kind = traits.byRadius;
    kernel.radius = *filter.radius;
  } else {
    kernel.kind = traits.bySize;
    kernel.size = traits.sized ? filter.size : 1;
  }
  kernel.reach = 0.5 * (kernel.size + 1);
  kernel.border = static_cast<int>(std::ceil(kernel.reach)) + 1;
  return kernel;
}

} // namespace gnomon
