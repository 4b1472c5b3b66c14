// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_RANDOM_H_
#define ICPSCAPE_SRC_SIMULATION_RANDOM_H_

#include <cstdint>

namespace icpscape {

/// The mixing step of SplitMix64 [Steele et al. 2014].
inline std::uint64_t MixBits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// One key from several numbers; the order matters.
template <class... Keys>
std::uint64_t MixKeys(std::uint64_t first, Keys... rest) {
  std::uint64_t key = MixBits(first);
  ((key = MixBits(key ^ static_cast<std::uint64_t>(rest))), ...);
  return key;
}

/// A stream of random numbers that is the same on every machine: integers and sums only, without
/// libm and the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t key) : state_(key) {}

  std::uint64_t Bits() { return MixBits(state_++); }

  /// Uniform in [0, 1).
  double Uniform() { return static_cast<double>(Bits() >> 11U) * 0x1p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  bool Chance(double probability) { return Uniform() < probability; }
  /// One of 0 .. count - 1.
  int Index(int count) { return static_cast<int>(Uniform() * count); }

  /// Zero mean, unit variance, nearly Gaussian: the sum of twelve uniform numbers, which ends at 6
  /// standard deviations.
  double Normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) {
      sum += Uniform();
    }
    return sum;
  }

 private:
  std::uint64_t state_;
};

/// Smooth noise over the plane in [-1, 1]: random values on a unit lattice, interpolated.
inline double LatticeNoise(double x, double y, std::uint64_t key) {
  const auto floor_to_int = [](double v) {
    const auto i = static_cast<std::int64_t>(v);
    return v < static_cast<double>(i) ? i - 1 : i;
  };
  const std::int64_t ix = floor_to_int(x);
  const std::int64_t iy = floor_to_int(y);
  const auto fade = [](double t) { return t * t * (3 - 2 * t); };
  const double fx = fade(x - static_cast<double>(ix));
  const double fy = fade(y - static_cast<double>(iy));
  const auto value = [&](std::int64_t i, std::int64_t j) {
    return 2 * Random(MixKeys(key, i, j)).Uniform() - 1;
  };
  return (1 - fy) * ((1 - fx) * value(ix, iy) + fx * value(ix + 1, iy)) +
         fy * ((1 - fx) * value(ix, iy + 1) + fx * value(ix + 1, iy + 1));
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_RANDOM_H_
