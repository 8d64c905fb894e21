// What the loops of the refinement do with vectors of depths, for either kind of depth. Included once for
// each instruction set.
#if defined(STDC_SEGMENTATION_REFINEMENT_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef STDC_SEGMENTATION_REFINEMENT_LANES
#undef STDC_SEGMENTATION_REFINEMENT_LANES
#else
#define STDC_SEGMENTATION_REFINEMENT_LANES
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Depths of 16 bits: 0 is missing and also "no claimant"; the smallest depth is the largest negative one.
struct Units {
  using T = std::uint16_t;
  using D = hn::ScalableTag<T>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  static T none() { return 0; }
  static HWY_INLINE V mirrored(V v) { return hn::Sub(hn::Zero(D()), v); }
  static HWY_INLINE M present(V v) { return hn::Ne(v, hn::Zero(D())); }
  static HWY_INLINE M at_most(V a, V b) { return hn::Eq(hn::SaturatedSub(a, b), hn::Zero(D())); }
  static HWY_INLINE V distance(V a, V b) { return hn::Sub(hn::Max(a, b), hn::Min(a, b)); }
  // `measure` of a claimant is at most `range` if it is within tau; never if there is no claimant.
  struct Gauge {
    V from, range;
    HWY_INLINE Gauge(V depth, V tau) {
      from = hn::Max(hn::SaturatedSub(depth, tau), hn::Set(D(), 1));
      range = hn::Sub(hn::SaturatedAdd(depth, tau), from);
    }
    HWY_INLINE V measure(V claimant) const { return hn::Sub(claimant, from); }
  };
};

// Depths in metres: what is not above 0 or not finite is missing; "no claimant" is minus infinity.
struct Metres {
  using T = float;
  using D = hn::ScalableTag<T>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  static T none() { return -__builtin_inff(); }
  static HWY_INLINE V mirrored(V v) { return hn::Neg(v); }
  static HWY_INLINE M present(V v) {
    return hn::And(hn::Gt(v, hn::Zero(D())), hn::Lt(v, hn::Set(D(), __builtin_inff())));
  }
  static HWY_INLINE M at_most(V a, V b) { return hn::Le(a, b); }
  static HWY_INLINE V distance(V a, V b) { return hn::Abs(hn::Sub(a, b)); }
  struct Gauge {
    V depth, range;
    HWY_INLINE Gauge(V d, V tau) : depth(d), range(tau) {}
    HWY_INLINE V measure(V claimant) const { return hn::Abs(hn::Sub(claimant, depth)); }
  };
};

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();
#endif
