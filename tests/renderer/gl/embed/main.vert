// Awkward text: ; [x] ] "q" \n @text@ ${foo}
#include "snippet.glsl"
  # include "types.h"
#include "snippet.glsl"
#include "last.glsl"
void main() {
  int a[2];
  a[0] = last();
  gl_Position = doubled(Pair(vec4(a[0]), vec4(0)));
}
