// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/point_columns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "icpscape/cloud/origin.h"
#include "icpscape/cloud/usable_point.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

using Names = std::vector<std::string>;

const Names kIntensity = {"intensity", "reflectivity"};
const Names kRing = {"ring", "line"};
const Names kTime = {"t", "time", "timestamp", "offset_time"};
const Names kLabel = {"label"};
const Names kTexture = {"s"};  // With it, t is the other coordinate in a picture, and no time.
const std::array<Names, 3> kPoint = {Names{"x"}, Names{"y"}, Names{"z"}};
const std::array<Names, 3> kNormal = {Names{"nx", "normal_x"}, Names{"ny", "normal_y"},
                                      Names{"nz", "normal_z"}};

constexpr double kLargestRing = 65535;

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

// The column of the first of these names; null where there is none.
const Column* Find(const PointTable& table, const Names& names) {
  for (const std::string& name : names) {
    const Column* found = nullptr;
    for (const Column& column : table.columns) {
      if (LowerCase(column.name) != name) {
        continue;
      }
      if (found != nullptr) {
        throw InputError(table.place + ": two fields " + name + "; expected one.");
      }
      found = &column;
    }
    if (found != nullptr) {
      return found;
    }
  }
  return nullptr;
}

template <class T>
std::vector<double> ValuesAs(const PointTable& table, const Column& column) {
  std::vector<double> values(table.size);
  const char* from = table.bytes.data() + column.begin;
  for (double& value : values) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    if (table.big_endian) {
      std::reverse(bytes.begin(), bytes.end());
    }
    T number;
    std::memcpy(&number, bytes.data(), sizeof(T));
    value = static_cast<double>(number);
    from += column.stride;
  }
  return values;
}

std::vector<double> Values(const PointTable& table, const Column& column) {
  switch (column.type) {
    case NumberType::kInt8:
      return ValuesAs<std::int8_t>(table, column);
    case NumberType::kInt16:
      return ValuesAs<std::int16_t>(table, column);
    case NumberType::kInt32:
      return ValuesAs<std::int32_t>(table, column);
    case NumberType::kInt64:
      return ValuesAs<std::int64_t>(table, column);
    case NumberType::kUint8:
      return ValuesAs<std::uint8_t>(table, column);
    case NumberType::kUint16:
      return ValuesAs<std::uint16_t>(table, column);
    case NumberType::kUint32:
      return ValuesAs<std::uint32_t>(table, column);
    case NumberType::kUint64:
      return ValuesAs<std::uint64_t>(table, column);
    case NumberType::kFloat:
      return ValuesAs<float>(table, column);
    default:
      return ValuesAs<double>(table, column);
  }
}

using Triple = std::array<std::vector<double>, 3>;

std::optional<Triple> FindTriple(const PointTable& table, const std::array<Names, 3>& names) {
  std::array<const Column*, 3> columns;
  for (std::size_t k = 0; k < 3; ++k) {
    columns[k] = Find(table, names[k]);
    if (columns[k] == nullptr) {
      return std::nullopt;
    }
  }
  return Triple{Values(table, *columns[0]), Values(table, *columns[1]), Values(table, *columns[2])};
}

// Which points a cloud can use.
std::vector<char> Usable(const Triple& p, DroppedPoints* dropped) {
  std::vector<char> keep(p[0].size(), 1);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    keep[i] = IsUsable(p[0][i], p[1][i], p[2][i], dropped) ? 1 : 0;
  }
  return keep;
}

template <class T>
std::vector<T> Kept(const std::vector<T>& values, const std::vector<char>& keep) {
  std::vector<T> kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) {
      kept.push_back(values[i]);
    }
  }
  return kept;
}

std::vector<float> Floats(const std::vector<double>& values, double less) {
  std::vector<float> floats(values.size());
  std::transform(values.begin(), values.end(), floats.begin(),
                 [less](double value) { return static_cast<float>(value - less); });
  return floats;
}

void SetNormals(Triple n, PointCloud* cloud) {
  for (std::size_t i = 0; i < n[0].size(); ++i) {
    const Vec3 normal(n[0][i], n[1][i], n[2][i]);
    const double length = normal.norm();
    const bool is_normal = std::isfinite(length) && length > 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      n[static_cast<std::size_t>(k)][i] = is_normal ? normal[k] / length : 0;
    }
  }
  cloud->nx = Floats(n[0], 0);
  cloud->ny = Floats(n[1], 0);
  cloud->nz = Floats(n[2], 0);
}

// Whole numbers from `least` to `most`. Throws InputError for any other.
std::vector<std::int64_t> WholeNumbers(const PointTable& table, const std::string& name,
                                       const std::vector<double>& values, double least,
                                       double most) {
  std::vector<std::int64_t> numbers;
  numbers.reserve(values.size());
  for (const double value : values) {
    if (!(value >= least && value <= most && value == std::floor(value))) {
      throw InputError(table.place + ": a point with " + name + " " + Number(value) +
                       "; expected a whole number from " + Number(least) + " to " + Number(most) +
                       ".");
    }
    numbers.push_back(static_cast<std::int64_t>(value));
  }
  return numbers;
}

void SetTimes(const std::vector<double>& values, bool are_whole, PointCloud* cloud) {
  if (!std::all_of(values.begin(), values.end(), [](double t) { return std::isfinite(t); })) {
    return;
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double span = *most - *least;
  constexpr double kLongestScanS = 100, kMostMicroseconds = 2e6;
  const bool are_seconds = !are_whole && span <= kLongestScanS;
  const double unit_s = are_seconds ? 1 : (span <= kMostMicroseconds ? 1e-6 : 1e-9);
  for (const double value : values) {
    cloud->time_s.push_back(static_cast<float>((value - *least) * unit_s));
  }
}

void SetOptional(const PointTable& table, const std::vector<char>& keep, PointCloud* cloud) {
  const auto kept = [&](const Column& column) { return Kept(Values(table, column), keep); };
  if (const Column* column = Find(table, kIntensity)) {
    cloud->intensity = Floats(kept(*column), 0);
  }
  if (const Column* column = Find(table, kRing)) {
    const auto rings = WholeNumbers(table, column->name, kept(*column), 0, kLargestRing);
    cloud->ring.assign(rings.begin(), rings.end());
  }
  if (const Column* column = Find(table, kLabel)) {
    for (const std::int64_t label :
         WholeNumbers(table, column->name, kept(*column), std::numeric_limits<std::int32_t>::min(),
                      std::numeric_limits<std::uint32_t>::max())) {
      cloud->label.push_back(static_cast<std::int32_t>(label));  // The same 32 bits.
    }
  }
  const Column* const time = Find(table, kTime);
  if (time != nullptr && (time->name.size() > 1 || Find(table, kTexture) == nullptr)) {
    SetTimes(kept(*time), IsWhole(time->type), cloud);
  }
  if (std::optional<Triple> normals = FindTriple(table, kNormal)) {
    for (std::vector<double>& values : *normals) {
      values = Kept(values, keep);
    }
    SetNormals(*std::move(normals), cloud);
  }
}

}  // namespace

std::size_t BytesOf(NumberType type) {
  switch (type) {
    case NumberType::kInt8:
    case NumberType::kUint8:
      return 1;
    case NumberType::kInt16:
    case NumberType::kUint16:
      return 2;
    case NumberType::kInt32:
    case NumberType::kUint32:
    case NumberType::kFloat:
      return 4;
    default:
      return 8;
  }
}

bool IsUsed(std::string_view name) {
  const std::string lower = LowerCase(name);
  const auto is_among = [&](const Names& names) {
    return std::find(names.begin(), names.end(), lower) != names.end();
  };
  return is_among(kTexture) || is_among(kIntensity) || is_among(kRing) || is_among(kTime) ||
         is_among(kLabel) || std::any_of(kPoint.begin(), kPoint.end(), is_among) ||
         std::any_of(kNormal.begin(), kNormal.end(), is_among);
}

// Whether a sensor at p can have seen the cloud: some writers give a pose on a map to points in the
// frame of the sensor. A small thing may have been seen from many times its size.
bool IsNear(const PointCloud& cloud, const Vec3& p) {
  constexpr double kMostDiagonals = 20;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    box.extend(cloud.Point(i));
  }
  return box.exteriorDistance(p) <= kMostDiagonals * box.diagonal().norm();
}

PointCloud CloudOf(const PointTable& table, DroppedPoints* dropped) {
  for (const Names& names : kPoint) {
    if (Find(table, names) == nullptr) {
      throw InputError(table.place + ": no field " + names[0] + "; expected x, y and z.");
    }
  }
  Triple p = *FindTriple(table, kPoint);
  *dropped = DroppedPoints();
  const std::vector<char> keep = Usable(p, dropped);
  for (std::vector<double>& values : p) {
    values = Kept(values, keep);
  }
  if (p[0].empty()) {
    throw InputError(table.place + ": no usable point among " + std::to_string(table.size) +
                     "; expected at least one that is finite and not (0, 0, 0).");
  }
  PointCloud cloud;
  cloud.origin = OriginOf(p[0], p[1], p[2]);
  cloud.x = Floats(p[0], cloud.origin.x());
  cloud.y = Floats(p[1], cloud.origin.y());
  cloud.z = Floats(p[2], cloud.origin.z());
  SetOptional(table, keep, &cloud);
  dropped->non_finite += DropStrays(&cloud);
  // Writers put 0 where they do not know it: far out the middle of the cloud is a better place.
  if (table.sensor && !table.sensor->isZero(0)) {
    const Vec3 sensor = *table.sensor - cloud.origin;
    if (IsNear(cloud, sensor)) {
      cloud.sensor = sensor;
    }
  }
  return cloud;
}

}  // namespace icpscape
