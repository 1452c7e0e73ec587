// GLSL's side of the names that the functions in shared/ are written with; C++'s is shared/functions.h.
#define GNOMON_FUNCTION
#define GNOMON_CONSTANT(name, value) const float name = value
#define GNOMON_OUT(type) out type
#define Real float
#define Whole int
#define Truth bool
#define select(condition, yes, no) ((condition) ? (yes) : (no))

// No macros: Mesa 22 loses its way where a variable has the name of one.
bool both(bool a, bool b) { return a && b; }
// A row of an affine matrix times a point.
float along(vec4 row, vec3 place) { return dot(row, vec4(place, 1.0)); }
