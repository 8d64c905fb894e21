// Four doubles as one value. Included by the kernel sources only, inside of their namespace.

using Lanes = double __attribute__((vector_size(32)));

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
