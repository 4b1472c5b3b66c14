// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_POINT_COLUMNS_H_
#define ICPSCAPE_SRC_IO_POINT_COLUMNS_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// How a file of points stores a number.
enum class NumberType {
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kUint8,
  kUint16,
  kUint32,
  kUint64,
  kFloat,
  kDouble
};
std::size_t BytesOf(NumberType type);
inline bool IsWhole(NumberType type) { return type < NumberType::kFloat; }

/// What the header of a file says about a part of each record.
struct Field {
  std::string name;
  NumberType type = NumberType::kFloat;
  std::size_t count = 1;                 ///< Numbers in a row; of a list each record says.
  std::optional<NumberType> list_count;  ///< A list: the type of the number of its numbers.
};

/// One number of every point. Of a field with several numbers a point it is the first.
struct Column {
  std::string name;
  NumberType type = NumberType::kFloat;
  std::size_t begin = 0;   ///< Byte of the first point's.
  std::size_t stride = 0;  ///< Bytes from a point's to the next one's.
};

/// The points of a file as its header describes them. All columns lie within the bytes.
struct PointTable {
  std::string place;  ///< For messages: the path of the file.
  std::string bytes;
  std::vector<Column> columns;
  std::size_t size = 0;
  bool big_endian = false;
  std::optional<Vec3> sensor;  ///< Where the file says that the sensor was.
};

/// Whether CloudOf uses a column of this name, in upper or lower case. These are, each with the
/// names it may have:
///   x, y, z; nx ny nz, or normal_x normal_y normal_z; intensity, reflectivity; ring, line;
///   t, time, timestamp, offset_time; label. With s, t is a coordinate in a picture, and not used.
bool IsUsed(std::string_view name);

/// The cloud. Points with a coordinate that is NaN, infinite or beyond 1e9 m are dropped and
/// counted, and those at (0, 0, 0). Coordinates are doubles until the origin is taken out (see
/// OriginOf). The sensor is where the file says; else at 0, or, where an origin was taken out, in
/// the cloud's middle.
///
/// Times become seconds from the earliest point. Whole numbers are nanoseconds, or microseconds
/// where all lie within 2e6; others are seconds, or, where they span more than 100, what whole
/// numbers are. A cloud with a point whose time is not finite has no times.
///
/// Throws InputError: no x, y or z; a field twice; a ring that is not a whole number from 0 to
/// 65535, or a label that is none of 32 bits; no usable point.
PointCloud CloudOf(const PointTable& table, DroppedPoints* dropped);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_POINT_COLUMNS_H_
