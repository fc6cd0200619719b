// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Pack operations that the laws of attraction need beyond arithmetic. Rules of inclusion as in pack.h.

#include "hooke/backends/cpu/pack.h"
#include "hooke/physics/attraction.h"

namespace hooke::HOOKE_ISA {

typedef std::uint32_t UInt32Vector __attribute__((vector_size(kPackBytes)));
typedef std::uint64_t UInt64Vector __attribute__((vector_size(kPackBytes)));

HOOKE_HD Pack<float> inverse_root_seed(const Pack<float>& a) {
  return Pack<float>((FloatVector)(0x5F1FFFF9U - ((UInt32Vector)a.v >> 1U)));
}
HOOKE_HD Pack<double> inverse_root_seed(const Pack<double>& a) {
  return Pack<double>((DoubleVector)(0x5FE3FFFF20000000ULL - ((UInt64Vector)a.v >> 1U)));
}
HOOKE_HD Pack<float> inverse_root(const Pack<float>& a) { return inverse_root_next(a, inverse_root_first(a)); }
HOOKE_HD Pack<double> inverse_root(const Pack<double>& a) {
  return inverse_root_next(a, inverse_root_next(a, inverse_root_first(a)));
}

// An estimate of 1 / sqrt(a), good for 12 bits or more: the processor's where it has one, whose bits differ between
// manufacturers.
#if defined(__AVX512F__)
HOOKE_HD Pack<float> guess_inverse_root(const Pack<float>& a) { return Pack<float>(_mm512_rsqrt14_ps(a.v)); }
HOOKE_HD Pack<double> guess_inverse_root(const Pack<double>& a) { return Pack<double>(_mm512_rsqrt14_pd(a.v)); }
HOOKE_HD Pack<float> fused(const Pack<float>& a, const Pack<float>& b, const Pack<float>& c) {
  return Pack<float>(_mm512_fmadd_ps(a.v, b.v, c.v));
}
HOOKE_HD Pack<double> fused(const Pack<double>& a, const Pack<double>& b, const Pack<double>& c) {
  return Pack<double>(_mm512_fmadd_pd(a.v, b.v, c.v));
}
#else
#if defined(__AVX2__)
HOOKE_HD Pack<float> guess_inverse_root(const Pack<float>& a) { return Pack<float>(_mm256_rsqrt_ps(a.v)); }
#else
HOOKE_HD Pack<float> guess_inverse_root(const Pack<float>& a) { return inverse_root_next(a, inverse_root_first(a)); }
#endif
HOOKE_HD Pack<double> guess_inverse_root(const Pack<double>& a) { return inverse_root_first(a); }
template <class Real>
HOOKE_HD Pack<Real> fused(const Pack<Real>& a, const Pack<Real>& b, const Pack<Real>& c) {
  return a * b + c;  // AVX2 does not promise the instruction
}
#endif

/// The laws' arithmetic where bits may differ between machines: fused operations, the processor's estimate.
struct FastMath {
  template <class Real>
  HOOKE_HD static Pack<Real> multiply_add(const Pack<Real>& a, const Pack<Real>& b, const Pack<Real>& c) {
    return fused(a, b, c);
  }
  // Floats take one step of Newton's, which doubles the correct digits; doubles take two steps that each triple them.
  HOOKE_HD static Pack<float> inverse_root_of(const Pack<float>& a) {
    const Pack<float> y = guess_inverse_root(a);
    return y * fused(Pack<float>(-0.5F) * a, y * y, Pack<float>(1.5F));
  }
  HOOKE_HD static Pack<double> inverse_root_of(const Pack<double>& a) {
    return inverse_root_next(a, inverse_root_next(a, guess_inverse_root(a)));
  }
};

}  // namespace hooke::HOOKE_ISA
