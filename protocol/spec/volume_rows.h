#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/volume_options.h"

/// The rows of volumes; see field_rows.h.
namespace gnomon {

inline constexpr Range kExtinctionRange{0, 1e6};
inline constexpr Range kGridValueRange{-1e9, 1e9};

template <>
inline constexpr auto kRows<VolumeBox> = rows(
    "VolumeBox", "A box along the world's axes.",
    field("min", &VolumeBox::min, {.says = "Its lowest corner.", .unit = "metres", .range = kPositionRange}),
    field("max", &VolumeBox::max,
          {.says = "Its highest corner, more than `min` along each axis.", .unit = "metres", .range = kPositionRange}));
static_assert(kRowsAreComplete<VolumeBox>);

template <>
inline constexpr auto kRows<TransferStop> = rows(
    "TransferStop", "Color and extinction of a value of the grid.",
    field("value", &TransferStop::value,
          {.says = "A value of the grid, more than that of the entry before.", .range = kGridValueRange}),
    field("color", &TransferStop::color,
          {.says = "Linear red, green and blue that is scattered of the light that is taken away; 1 1 1 for a cloud, "
                   "0 0 0 for soot.",
           .range = kUnitRange}),
    field("extinction", &TransferStop::extinction,
          {.says = "Light that is taken away on a metre: exp(-extinction) is let through.",
           .unit = "per metre",
           .range = kExtinctionRange}));
static_assert(kRowsAreComplete<TransferStop>);

template <>
inline constexpr auto kRows<VolumeOptions> =
    rows(
        "VolumeOptions",
        "A cloud, smoke or fog: numbers on a grid, which `node`, `box` or `matrix` places in the scene.",
        field("file", &VolumeOptions::file,
              {.says = "Name of a file of the upload: .npy (an array `[z, y, x]` of float32, float16 or uint8) or .vdb "
                       "(OpenVDB); required.",
               .minCount = 1,
               .maxCount = 255}),
        field("grid", &VolumeOptions::grid,
              {.says = "Name of a float grid of a .vdb; absent = the only one.", .minCount = 1, .maxCount = 255}),
        field("node", &VolumeOptions::node,
              {.says =
                   "A node of the scene that the volume is attached to and moves with, by its index or name: `box` or "
                   "`matrix` is in its space, without both the grid fills the cube from 0 to 1 there. It is seen, "
                   "casts and receives as the node does, whose layers do not matter.",
               .range = kNodeRange,
               .minCount = 1,
               .maxCount = 1024}),
        field("box", &VolumeOptions::box, {.says = "The box that the grid fills."}),
        field("matrix", &VolumeOptions::matrix,
              {.says = "Instead of `box`: the affine matrix, column by column, that takes the unit cube which the grid "
                       "fills into the world, in metres, or into the space of `node`.",
               .range = kPositionRange}),
        field("transferFunction", &VolumeOptions::transferFunction,
              {.says = "What values of the grid mean, in ascending order: linear between two entries, and beyond the "
                       "first and last as these say; required.",
               .minCount = 1,
               .maxCount = kLimits.maxTransferStops}),
        field("castShadow", &VolumeOptions::castShadow,
              {.says = "False = it dims the light of no surface and no volume, itself included."}),
        field("receiveShadow", &VolumeOptions::receiveShadow, {.says = "False = no surface and no volume shades it."}))
        .withAlternatives({"box", "matrix"});
static_assert(kRowsAreComplete<VolumeOptions>);

} // namespace gnomon
