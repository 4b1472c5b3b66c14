// SPDX-License-Identifier: BSD-3-Clause
// Eight doubles that are computed with as if they were one: with Lanes as their scalar, Eigen's
// matrices and the metrics of residuals/ work on eight pairs at once. Eight at every SIMD level,
// whatever the vectors' width, so that sums over lanes are the same bits at every level.
//
// For the files that are compiled once per level, as vectors.h: Lanes has internal linkage, and so
// has every template that is instantiated with it.
#ifndef ICPSCAPE_SRC_SIMD_LANES_H_
#define ICPSCAPE_SRC_SIMD_LANES_H_

#define EIGEN_DONT_VECTORIZE  // Lanes are vectors already.
#include <Eigen/Core>

#include "icpscape/simd/vectors.h"

namespace icpscape {
namespace {

constexpr int kLanes = 8;

class Lanes {
 public:
  Lanes() = default;
  Lanes(double value) {  // NOLINT(google-explicit-constructor): a number is a scalar.
    for (DoubleV& v : vectors_) {
      v = Splat(value);
    }
  }

  static Lanes Load(const double* from) {
    Lanes lanes;
    for (DoubleV& v : lanes.vectors_) {
      v = LoadDoubles(from);
      from += kDoubles;
    }
    return lanes;
  }
  static Lanes Load(const float* from) {
    typedef float HalfV __attribute__((vector_size(4 * kDoubles)));
    Lanes lanes;
    for (DoubleV& v : lanes.vectors_) {
      HalfV half;
      __builtin_memcpy(&half, from, sizeof half);
      v = __builtin_convertvector(half, DoubleV);
      from += kDoubles;
    }
    return lanes;
  }
  void StoreTo(double* to) const {
    for (const DoubleV& v : vectors_) {
      Store(v, to);
      to += kDoubles;
    }
  }

  /// Lane after lane.
  double Sum() const {
    double lanes[kLanes];
    StoreTo(lanes);
    double sum = 0;
    for (const double lane : lanes) {
      sum += lane;
    }
    return sum;
  }

  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  Lanes& operator/=(const Lanes& b) { return *this = *this / b; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return Map(a, b, [](DoubleV x, DoubleV y) { return x + y; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return Map(a, b, [](DoubleV x, DoubleV y) { return x - y; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return Map(a, b, [](DoubleV x, DoubleV y) { return x * y; });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return Map(a, b, [](DoubleV x, DoubleV y) { return x / y; });
  }
  friend Lanes operator-(const Lanes& a) {
    return Map(a, a, [](DoubleV x, DoubleV) { return -x; });
  }
  friend Lanes sqrt(const Lanes& a) {
    return Map(a, a, [](DoubleV x, DoubleV) { return Sqrt(x); });
  }
  friend Lanes abs(const Lanes& a) {
    return Map(a, a, [](DoubleV x, DoubleV) { return x < 0.0 ? -x : x; });
  }
  // What a metric that branches on a pair's values calls instead; see edge_to_line.h.
  friend Lanes RootOrZero(const Lanes& a) {
    return Map(a, a, [](DoubleV x, DoubleV) { return x > 0.0 ? Sqrt(x) : DoubleV{}; });
  }
  friend Lanes InverseOrZero(const Lanes& a) {
    return Map(a, a, [](DoubleV x, DoubleV) { return x > 0.0 ? 1.0 / x : DoubleV{}; });
  }

  /// 1 where x, y or z is not zero, else 0.
  friend Lanes IsNotZero(const Lanes& x, const Lanes& y, const Lanes& z) {
    Lanes result;
    for (int i = 0; i < kVectors; ++i) {
      const LongV any = (x.vectors_[i] != 0.0) | (y.vectors_[i] != 0.0) | (z.vectors_[i] != 0.0);
      result.vectors_[i] = any ? Splat(1.0) : DoubleV{};
    }
    return result;
  }

  // One branch is taken for all lanes. That is right for what depends only on the pose; a metric
  // whose pairs need different branches stops here, at its first test.
  friend bool operator<(const Lanes& a, const Lanes& b) {
    return Agreed(a, b, [](double x, double y) { return x < y; });
  }
  friend bool operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend bool operator<=(const Lanes& a, const Lanes& b) { return !(b < a); }
  friend bool operator>=(const Lanes& a, const Lanes& b) { return !(a < b); }
  friend bool operator==(const Lanes& a, const Lanes& b) {
    return Agreed(a, b, [](double x, double y) { return x == y; });
  }
  friend bool operator!=(const Lanes& a, const Lanes& b) { return !(a == b); }

 private:
  static constexpr int kVectors = kLanes / kDoubles;

  template <class F>
  static Lanes Map(const Lanes& a, const Lanes& b, const F& f) {
    Lanes result;
    for (int i = 0; i < kVectors; ++i) {
      result.vectors_[i] = f(a.vectors_[i], b.vectors_[i]);
    }
    return result;
  }
  template <class F>
  static bool Agreed(const Lanes& a, const Lanes& b, const F& f) {
    double x[kLanes], y[kLanes];
    a.StoreTo(x);
    b.StoreTo(y);
    for (int i = 1; i < kLanes; ++i) {
      if (f(x[i], y[i]) != f(x[0], y[0])) {
        __builtin_trap();
      }
    }
    return f(x[0], y[0]);
  }

  DoubleV vectors_[kVectors];
};

}  // namespace
}  // namespace icpscape

namespace Eigen {

template <>
struct NumTraits<icpscape::Lanes> : GenericNumTraits<icpscape::Lanes> {
  using Real = icpscape::Lanes;
  using NonInteger = icpscape::Lanes;
  using Nested = icpscape::Lanes;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
  static Real epsilon() { return Real(2.220446049250313e-16); }
  static Real dummy_precision() { return Real(1e-12); }
};

}  // namespace Eigen

#endif  // ICPSCAPE_SRC_SIMD_LANES_H_
