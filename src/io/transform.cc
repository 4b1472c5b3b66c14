// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/transform.h"

#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

constexpr double kRigidTolerance = 1e-3;

}  // namespace

SE3d ParseTransform(const std::string& text, const std::string& place) {
  std::istringstream in(text);
  std::vector<double> v;
  for (std::string word; in >> word;) {
    std::size_t used = 0;
    double value = 0;
    try {
      value = std::stod(word, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != word.size()) {
      throw InputError(place + ": \"" + word.substr(0, 40) + "\"; expected a number.");
    }
    v.push_back(value);
  }
  if (v.size() != 12 && v.size() != 16) {
    throw InputError(place + ": " + std::to_string(v.size()) +
                     " numbers; expected a 3x4 or 4x4 matrix (12 or 16 numbers).");
  }
  Mat3 R;
  R << v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10];
  const Vec3 t(v[3], v[7], v[11]);
  const bool last_row_fits =
      v.size() == 12 || (v[12] == 0 && v[13] == 0 && v[14] == 0 && v[15] == 1);
  const bool orthonormal = ((R.transpose() * R - Mat3::Identity()).norm() <= kRigidTolerance) &&
                           R.determinant() > 0;  // False for NaN.
  if (!last_row_fits || !orthonormal || !t.allFinite()) {
    throw InputError(place + ": the matrix is not rigid; expected a rotation (R^T R = I, det 1) " +
                     "and a finite translation, with last row 0 0 0 1.");
  }
  return SE3d(R, t).Normalized();
}

SE3d ReadTransform(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) {
    throw InputError(path.string() + ": cannot be read; expected a 4x4 matrix as text.");
  }
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return ParseTransform(text, path.string());
}

std::string FormatTransform(const SE3d& T) {
  const Mat<double, 4, 4> m = T.Matrix();
  std::string out;
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) {
      out += Number(m(row, col)) + (col < 3 ? " " : "\n");
    }
  }
  return out;
}

std::string FormatTransformRow(const SE3d& T) {
  std::vector<std::string> numbers;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) {
      numbers.push_back(Number(T.R()(row, col)));
    }
    numbers.push_back(Number(T.t()(row)));
  }
  return Join(numbers, " ");
}

}  // namespace icpscape
