#include "types.h"
vec4 doubled(Pair pair) { return pair.first * 2.0; }
