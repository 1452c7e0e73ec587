#include "snippet.glsl"
#include "elsewhere.glsl"
void main() {}
