// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_KINDS_H_
#define ICPSCAPE_RESIDUALS_KINDS_H_

#include <cstddef>

#include "lie.h"

// What a quantity of a correspondence can be. Each kind says what type it is (Value), how many
// numbers hold it where pairs are stored (kSize), how the two convert into each other (Make takes a
// function from 0 to kSize - 1 to its numbers; NumberOf), and how it looks from another frame into
// which G = [R t] leads (InFrame). Those that a cloud can be without at some of its points have a
// Mark: three numbers that are all 0 where there is none.
namespace icpscape::kind {

namespace internal {

// Three numbers.
struct Triple {
  static constexpr std::size_t kSize = 3;
  template <class S>
  using Value = Vec<S, 3>;

  template <class S, class Number>
  static Value<S> Make(const Number& number) {
    return {number(0), number(1), number(2)};
  }
  template <class S>
  static S NumberOf(const Value<S>& x, std::size_t k) {
    return x[static_cast<Eigen::Index>(k)];
  }
};

}  // namespace internal

/// A place: x' = R x + t.
struct Point : internal::Triple {
  template <class S>
  static Value<S> InFrame(const SE3<S>& G, const Value<S>& x) {
    return G * x;
  }
};

/// A vector that turns with its frame and does not move: x' = R x.
struct Direction : internal::Triple {
  template <class S>
  static Value<S> InFrame(const SE3<S>& G, const Value<S>& x) {
    return G.R() * x;
  }
  template <class S>
  static const Vec<S, 3>& Mark(const Value<S>& x) {
    return x;
  }
};

/// A symmetric 3x3 matrix, such as a covariance: C' = R C R^T. Its numbers are the upper triangle,
/// row by row.
struct Matrix {
  static constexpr std::size_t kSize = 6;
  template <class S>
  using Value = Mat<S, 3, 3>;

  template <class S, class Number>
  static Value<S> Make(const Number& number) {
    Value<S> C;
    for (std::size_t k = 0; k < kSize; ++k) {
      C(kRow[k], kColumn[k]) = C(kColumn[k], kRow[k]) = number(k);
    }
    return C;
  }
  template <class S>
  static S NumberOf(const Value<S>& C, std::size_t k) {
    return C(kRow[k], kColumn[k]);
  }
  template <class S>
  static Value<S> InFrame(const SE3<S>& G, const Value<S>& C) {
    return G.R() * C * G.R().transpose();
  }
  template <class S>
  static Vec<S, 3> Mark(const Value<S>& C) {
    return C.diagonal();
  }

 private:
  static constexpr int kRow[kSize] = {0, 0, 0, 1, 1, 2};
  static constexpr int kColumn[kSize] = {0, 1, 2, 1, 2, 2};
};

/// A rotation from the source into the target frame. Of two frames, so that it has no InFrame:
/// R' = G_target R G_source^T.
struct Rotation {
  static constexpr std::size_t kSize = 9;  ///< Column by column.
  template <class S>
  using Value = Mat<S, 3, 3>;

  template <class S, class Number>
  static Value<S> Make(const Number& number) {
    Value<S> R;
    for (std::size_t k = 0; k < kSize; ++k) {
      R(static_cast<Eigen::Index>(k)) = number(k);
    }
    return R;
  }
  template <class S>
  static S NumberOf(const Value<S>& R, std::size_t k) {
    return R(static_cast<Eigen::Index>(k));
  }
};

/// One number, the same from every frame.
struct Scalar {
  static constexpr std::size_t kSize = 1;
  template <class S>
  using Value = S;

  template <class S, class Number>
  static S Make(const Number& number) {
    return number(0);
  }
  template <class S>
  static S NumberOf(const S& x, std::size_t /*k*/) {
    return x;
  }
  template <class S>
  static S InFrame(const SE3<S>& /*G*/, const S& x) {
    return x;
  }
};

template <class... Kinds>
struct List {};
using All = List<Point, Direction, Matrix, Rotation, Scalar>;

}  // namespace icpscape::kind

#endif  // ICPSCAPE_RESIDUALS_KINDS_H_
