#pragma once

#include "protocol/spec/output_options.h"
#include "renderer/frame/measured_shadow.h"
#include "renderer/image/image.h"

/// Pictures that compare the shadow of debug.light with rays.
namespace gnomon {

/// reference: V. error: S - V, 0 where no receiver. edgeDistance: pixels, -1 = no edge, infinity where V has none.
Image errorNumbers(const MeasuredShadow& measured, View view);

/// V as grey, 0 black.
Image referencePicture(const MeasuredShadow& measured);

/// error: false shadow red, false light blue. edgeDistance: the edge pixels of S by their distance, a heat map from 0
/// to 16 pixels. Over `color`, a picture of the same size, in dim grey.
Image errorPicture(const MeasuredShadow& measured, View view, const Image& color);

} // namespace gnomon
