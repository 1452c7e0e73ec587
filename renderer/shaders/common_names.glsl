// GLSL's side of the names that the functions in shared/ are written with; C++'s is shared/functions.h.
#define GNOMON_FUNCTION
#define GNOMON_CONSTANT(name, value) const float name = value
#define GNOMON_OUT(type) out type
#define Real float
#define select(condition, yes, no) ((condition) ? (yes) : (no))
