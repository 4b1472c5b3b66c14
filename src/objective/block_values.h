// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_BLOCK_VALUES_H_
#define ICPSCAPE_SRC_OBJECTIVE_BLOCK_VALUES_H_

#include <cstddef>
#include <type_traits>

#include "icpscape/residuals/correspondence.h"

namespace icpscape {

constexpr std::size_t kBlockPairs = 128;

namespace internal {

// Whether anything of the kind comes from there.
template <class Kind>
constexpr bool Comes(Origin origin) {
  bool comes = false;
  ForEachQuantity<double>([&](auto row) {
    using Row = decltype(row);
    comes |= Row::kOrigin == origin && std::is_same_v<typename Row::Kind, Kind>;
  });
  return comes;
}

template <class Kind, class... Kinds>
constexpr std::size_t NumbersBefore(Origin origin, kind::List<Kinds...>) {
  std::size_t numbers = 0;
  bool before = true;
  ((before = before && !std::is_same_v<Kind, Kinds>,
    numbers += before && Comes<Kinds>(origin) ? Kinds::kSize : 0),
   ...);
  return numbers;
}

}  // namespace internal

/// What comes from an origin is stored number by number, kind after kind: those of a kind from
/// here.
template <class Kind>
constexpr std::size_t FirstNumber(Origin origin) {
  return internal::NumbersBefore<Kind>(origin, kind::All{});
}
/// How many there are.
constexpr std::size_t NumbersFrom(Origin origin) {
  return internal::NumbersBefore<void>(origin, kind::All{});
}

/// A block of pairs, number by number side by side. Arrays can be read in eights, also behind the
/// last pair; what is there is finite.
struct BlockValues {
  double fit[NumbersFrom(Origin::kFit)][kBlockPairs];
  float target[NumbersFrom(Origin::kTargetCloud)][kBlockPairs];
  float matched[kBlockPairs];  ///< 1 for a pair, 0 for a source point without a match.
  const float* source[NumbersFrom(Origin::kSourceCloud)];
  double matching[NumbersFrom(Origin::kMatching)];
  std::size_t size;
};

inline double IsNotZero(double x, double y, double z) { return x != 0 || y != 0 || z != 0 ? 1 : 0; }

namespace internal {

template <Origin kOrigin, class Scalar, class Load>
Scalar LoadNumber(const BlockValues& block, std::size_t number, std::size_t i, const Load& load) {
  if constexpr (kOrigin == Origin::kSourceCloud) {
    return load(block.source[number] + i);
  } else if constexpr (kOrigin == Origin::kTargetCloud) {
    return load(block.target[number] + i);
  } else if constexpr (kOrigin == Origin::kFit) {
    return load(block.fit[number] + i);
  } else {
    return Scalar(block.matching[number]);
  }
}

}  // namespace internal

/// The pairs from i on as metrics over Scalar take them: as many as load(pointer) reads numbers.
/// What is not needed stays unset. `weight` becomes 1 for a pair that has all that is needed, else
/// 0.
template <class Scalar, class Load>
CorrespondenceOf<Scalar> LoadPairs(const BlockValues& block, std::size_t i, unsigned needs,
                                   const Load& load, Scalar* weight) {
  CorrespondenceOf<Scalar> pairs;
  ForEachQuantity<Scalar>([&](auto row) {
    using Row = decltype(row);
    using Kind = typename Row::Kind;
    if (Row::IsNeededBy(needs)) {
      constexpr std::size_t kFirst = FirstNumber<Kind>(Row::kOrigin);
      pairs.*Row::kMember = Kind::template Make<Scalar>([&](std::size_t k) {
        return internal::LoadNumber<Row::kOrigin, Scalar>(block, kFirst + k, i, load);
      });
    }
  });
  *weight = load(block.matched + i);
  ForEachQuantity<Scalar>([&](auto row) {
    using Row = decltype(row);
    if constexpr (Row::kCanBeMissing) {
      if (Row::IsNeededBy(needs)) {
        const Vec<Scalar, 3>& mark = Row::Kind::template Mark<Scalar>(pairs.*Row::kMember);
        *weight *= IsNotZero(mark.x(), mark.y(), mark.z());
      }
    }
  });
  return pairs;
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_BLOCK_VALUES_H_
