// Where the tables of MaskCoverage (renderer/scene/mask_coverage.h) lie for shaders, all behind one another. A
// material's `passing` says which is its own: y is the first row, z the number of the last one from there on, or 0
// where it has none; w is 1 where its levels are mixed.
#ifdef __cplusplus
#pragma once
#endif

#define GNOMON_COVERAGE_BUFFER 4 // storage buffer binding
#define GNOMON_COVERAGE_ROW 257  // numbers of a row
