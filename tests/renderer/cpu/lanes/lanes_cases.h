// What lanes and single numbers must agree on: one text for both. X(name, largest share that may differ, expression) of
// the numbers a, b and c and the whole numbers i and j.
#define GNOMON_LANE_CASES(X)                                                                   \
  X(Sum, 0, a + b)                                                                             \
  X(Difference, 0, a - b)                                                                      \
  X(Product, 0, a* b)                                                                          \
  X(Quotient, 0, a / b)                                                                        \
  X(Negative, 0, -a)                                                                           \
  X(Least, 0, min(a, b))                                                                       \
  X(Most, 0, max(a, b))                                                                        \
  X(Size, 0, abs(a))                                                                           \
  X(Fused, 3e-5f, mulAdd(a, b, c))                                                             \
  X(Floor, 0, floor(a))                                                                        \
  X(Ceiling, 0, ceil(a))                                                                       \
  X(Fraction, 0, fract(a))                                                                     \
  X(Root, 0, sqrt(abs(a)))                                                                     \
  X(InverseRoot, 3e-7f, inversesqrt(abs(a) + Number(1e-30f)))                                  \
  X(Power, 1e-6f, exp(a))                                                                      \
  X(PowerOfTwo, 2e-6f, exp2(a))                                                                \
  X(Logarithm, 1e-6f, log2(abs(a)))                                                            \
  X(Sine, 1e-6f, sin(a))                                                                       \
  X(Cosine, 1e-6f, cos(a))                                                                     \
  X(Clamped, 0, clamp(a, Number(-2.0f), Number(3.0f)))                                         \
  X(Mixed, 0, mix(a, b, c))                                                                    \
  X(Smooth, 0, smoothstep(Number(-4.0f), Number(5.0f), a))                                     \
  X(Truncated, 0, toFloat(truncated(a)))                                                       \
  X(Nearest, 0, toFloat(nearest(a)))                                                           \
  X(SameBits, 0, floatOf(bitsOf(a)))                                                           \
  X(Less, 0, select(a < b, c, a))                                                              \
  X(Greater, 0, select(a > b, c, a))                                                           \
  X(NotLess, 0, select(a >= floor(a) + Number(0.5f), c, a))                                    \
  X(NotGreater, 0, select(a <= b, c, a))                                                       \
  X(Equal, 0, select(floor(a) == floor(b), c, a))                                              \
  X(Unequal, 0, select(floor(a) != floor(b), c, a))                                            \
  X(Both, 0, select((a < b) & (b < c), c, a))                                                  \
  X(Either, 0, select((a < b) | (b < c), c, a))                                                \
  X(Without, 0, select(andNot(a < b, b < c), c, a))                                            \
  X(Not, 0, select(!(a < b), c, a))                                                            \
  X(WholeSum, 0, toFloat(i + j))                                                               \
  X(WholeDifference, 0, toFloat(i - j))                                                        \
  X(WholeProduct, 0, toFloat(i* j))                                                            \
  X(WholeLeast, 0, toFloat(min(i, j)))                                                         \
  X(WholeMost, 0, toFloat(max(i, j)))                                                          \
  X(BitsOfBoth, 0, toFloat(i& j))                                                              \
  X(BitsOfEither, 0, toFloat(i | j))                                                           \
  X(BitsOfOne, 0, toFloat(i ^ j))                                                              \
  X(ShiftedLeft, 0, toFloat(shiftLeft<3>(i)))                                                  \
  X(ShiftedRight, 0, toFloat(shiftRight<3>(i)))                                                \
  X(ShiftedRightUnsigned, 0, toFloat(shiftRightUnsigned<3>(i)))                                \
  X(WholeLess, 0, toFloat(select(i < j, i, j + Whole(7))))                                     \
  X(WholeNotLess, 0, toFloat(select(i >= shiftLeft<2>(shiftRight<2>(i)) + Whole(2), i, j)))    \
  X(WholeNotGreater, 0, toFloat(select(i <= shiftLeft<2>(shiftRight<2>(i)) + Whole(2), i, j))) \
  X(WholeEqual, 0, toFloat(select((i & Whole(3)) == Whole(2), i, j)))                          \
  X(WholeUnequal, 0, toFloat(select((i & Whole(3)) != Whole(2), i, j)))
