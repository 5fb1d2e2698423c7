/// Complex numbers, a lane each.
#pragma once

#include "engine/kernel/lanes.inl"

namespace portrait::PORTRAIT_ISA_NAME {

struct Complex {
  Lanes re, im;
};
inline Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
inline Complex operator-(Complex a) { return {-a.re, -a.im}; }
inline Complex operator*(Complex a, Complex b) {
  return {mul_sub_from(a.im, b.im, a.re * b.re), mul_add(a.re, b.im, a.im * b.re)};
}
inline Complex operator*(Lanes a, Complex b) { return {a * b.re, a * b.im}; }
inline Complex conjugate(Complex a) { return {a.re, -a.im}; }
inline Lanes norm(Complex a) { return mul_add(a.re, a.re, a.im * a.im); }
/// Re(conj(a) b)
inline Lanes inner(Complex a, Complex b) { return mul_add(a.re, b.re, a.im * b.im); }
inline Complex select(Mask mask, Complex a, Complex b) {
  return {select(mask, a.re, b.re), select(mask, a.im, b.im)};
}

}  // namespace portrait::PORTRAIT_ISA_NAME
