#pragma once

#include <vector>

#include "protocol/evaluation/evaluation.h"

namespace gnomon {

/// Says of every row whether it is on the front of speed against error: nothing that was measured is faster and
/// misclassifies no more, or misclassifies less and is no slower. Rows without figures are not.
void markPareto(std::vector<EvaluationRow>& rows);

} // namespace gnomon
