// Where the tables of MaskCoverage (renderer/scene/mask_coverage.h) lie for shaders, all behind one another. A
// material says which rows are its own.
#ifdef __cplusplus
#pragma once
#endif

#define GNOMON_COVERAGE_BUFFER 4 // storage buffer binding
#define GNOMON_COVERAGE_ROW 257  // numbers of a row
