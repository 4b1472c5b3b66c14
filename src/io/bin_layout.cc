// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/bin_layout.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

// Floats that are whole points of 3 to 8 floats; a column keeps its place from part to part.
constexpr std::size_t kPart = 840;
constexpr std::size_t kMostParts = 64;

// Numbers of parts of the file, spread over it.
std::vector<float> SomeOf(const std::string& bytes) {
  const std::size_t parts = bytes.size() / sizeof(float) / kPart;
  const std::size_t every = 1 + parts / kMostParts;
  std::vector<float> values;
  for (std::size_t part = 0; part < parts; part += every) {
    values.resize(values.size() + kPart);
    std::memcpy(values.data() + values.size() - kPart, bytes.data() + part * kPart * sizeof(float),
                kPart * sizeof(float));
  }
  return values;
}

// Half of a double, or an integer, read as a float.
bool IsAbsurd(float value) {
  const double size = std::abs(static_cast<double>(value));
  return size > 1e9 || (size > 0 && size < 1e-30);
}

// Over the numbers that are finite.
double Variance(const std::vector<float>& values, std::size_t first, std::size_t stride) {
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = first; i < values.size(); i += stride) {
    const double value = values[i];
    if (std::isfinite(value) && std::abs(value) < 1e9) {
      n += 1;
      sum += value;
      squares += value * value;
    }
  }
  return n == 0 ? 0 : std::max(0.0, squares / n - (sum / n) * (sum / n));
}

double MeanLogVariance(const std::vector<float>& values, std::size_t stride) {
  const double least = 1e-6 * Variance(values, 0, 1) + 1e-12;  // A column may be constant.
  double sum = 0;
  for (std::size_t column = 0; column < stride; ++column) {
    sum += std::log(std::max(least, Variance(values, column, stride)));
  }
  return sum / static_cast<double>(stride);
}

}  // namespace

void CheckFourFloats(const std::string& place, const std::string& bytes) {
  const std::vector<float> values = SomeOf(bytes);
  const std::string expected = "; expected KITTI's x y z intensity, as float32.";
  const auto absurd = std::count_if(values.begin(), values.end(), IsAbsurd);
  if (10 * static_cast<std::size_t>(absurd) > values.size()) {
    throw InputError(place + ": one number in ten, or more, is no coordinate as float32" +
                     expected);
  }
  if (values.empty()) {
    return;
  }
  constexpr double kMargin = 0.3;
  // Every second point of a column of lasers may be one of the upper half, at a stride of 8.
  constexpr double kMarginOfMultiples = 1;
  const double four = MeanLogVariance(values, 4);
  double least = four - kMargin;
  std::size_t best = 4;
  for (const std::size_t floats : {3U, 5U, 6U, 7U, 8U}) {
    const double spread = MeanLogVariance(values, floats);
    const bool fits = bytes.size() % (floats * sizeof(float)) == 0 &&
                      (floats % 4 != 0 || spread < four - kMarginOfMultiples);
    if (fits && spread < least) {
      constexpr double kChance = 0.1;  // 6 floats are 3 as well.
      least = spread - kChance;
      best = floats;
    }
  }
  if (best != 4) {
    throw InputError(place + ": the numbers repeat every " + std::to_string(best) +
                     " floats, not every 4" + (best == 3 ? ", as x y z do" : "") +
                     (best == 5 ? ", as x y z intensity ring do" : "") + expected);
  }
}

}  // namespace icpscape
