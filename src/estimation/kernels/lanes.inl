// Four doubles as one value. Included by the kernel sources only, inside of their namespace.

using Lanes = double __attribute__((vector_size(32), may_alias));

#define STDC_INLINE inline __attribute__((always_inline))

STDC_INLINE Lanes load(const double* p) { return *reinterpret_cast<const Lanes*>(p); }
STDC_INLINE void store(double* p, const Lanes& v) { *reinterpret_cast<Lanes*>(p) = v; }
STDC_INLINE Lanes all(double v) { return Lanes{v, v, v, v}; }
STDC_INLINE double sum(const Lanes& v) { return (v[0] + v[1]) + (v[2] + v[3]); }
STDC_INLINE Lanes square_root(const Lanes& v) {
  return Lanes{__builtin_sqrt(v[0]), __builtin_sqrt(v[1]), __builtin_sqrt(v[2]), __builtin_sqrt(v[3])};
}

/// Huber's kernel with the bend at the squared residual `bend`: the weight of the reweighted least squares
/// and the cost.
STDC_INLINE void huber(const Lanes& chi_square, double bend, Lanes* weight, Lanes* cost) {
  const Lanes root = square_root(all(bend) * chi_square);  // k * |r|
  *weight = chi_square <= bend ? all(1.0) : all(bend) / root;
  *cost = chi_square <= bend ? chi_square : 2.0 * root - bend;
}

STDC_INLINE Lanes load(const float* p) {
  return Lanes{double{p[0]}, double{p[1]}, double{p[2]}, double{p[3]}};
}

/// Four rows of four become four columns.
STDC_INLINE void transpose(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d, Lanes* out) {
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);  // a0 b0 a2 b2
  const Lanes ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  out[0] = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  out[2] = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  out[3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}
