// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/bin_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "icpscape/common/error.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "tests/support/message_of.h"
#include "tests/support/point_file_writer.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::MessageOf;

// The room's points, in no order, with more numbers behind x y z.
std::string Bytes(int points, const std::vector<float>& more) {
  const PointCloud cloud = testing_support::Room(points, 1);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  std::string bytes;
  for (const std::size_t i : order) {
    std::vector<float> record = {cloud.x[i], cloud.y[i], cloud.z[i]};
    for (std::size_t k = 0; k < more.size(); ++k) {
      record.push_back(more[k] * static_cast<float>((i * (7 + k)) % 16) / 16);
    }
    bytes.append(reinterpret_cast<const char*>(record.data()), record.size() * sizeof(float));
  }
  return bytes;
}

std::string MessageOn(const std::string& bytes) {
  return MessageOf<InputError>([&] { CheckFourFloats("a.bin", bytes); });
}

TEST(BinLayout, FourFloatsPass) {
  for (const float intensity : {0.0F, 1.0F, 255.0F}) {
    EXPECT_EQ(MessageOn(Bytes(2520, {intensity})), "nothing was thrown") << intensity;
  }
  EXPECT_EQ(MessageOn(Bytes(20, {1, 32})), "nothing was thrown");  // Too few to tell.
  EXPECT_EQ(MessageOn(""), "nothing was thrown");
}

TEST(BinLayout, OtherNumbersOfFloatsAreNamed) {
  EXPECT_THAT(MessageOn(Bytes(2520, {})), HasSubstr("every 3 floats, not every 4, as x y z do"));
  EXPECT_THAT(MessageOn(Bytes(2520, {1, 32})),
              HasSubstr("every 5 floats, not every 4, as x y z intensity ring do; expected KITTI"));
  EXPECT_THAT(MessageOn(Bytes(2520, {0.1F, 1, 0.05F})), HasSubstr("every 6 floats"));
  EXPECT_THAT(MessageOn(Bytes(2520, {0, 100, 16, 0.1F, 0})), HasSubstr("every 8 floats"));
}

TEST(BinLayout, DoublesAreNoFloats) {
  const PointCloud cloud = testing_support::Room(3000, 1);
  std::string bytes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double record[] = {cloud.x[i] * 1.1, cloud.y[i] * 1.1, cloud.z[i] * 1.1};
    bytes.append(reinterpret_cast<const char*>(record), sizeof record);
  }
  EXPECT_THAT(MessageOn(bytes), HasSubstr("a.bin: "));
}

// A column of 16 lasers after the other, a lower and an upper one in turn, as VLP-16 fire.
TEST(BinLayout, FiringOrderPasses) {
  std::string bytes;
  for (int i = 0; i < 4000; ++i) {
    const int laser = i % 16;
    const double elevation = (laser % 2 == 0 ? laser - 15 : laser) * M_PI / 180;
    const double azimuth = i / 16 * 2 * M_PI / 250;
    const double range = laser % 2 == 0 ? 8 : 20 + 5 * std::sin(3 * azimuth);
    for (const double value :
         {range * std::cos(azimuth), range * std::sin(azimuth), range * std::sin(elevation), 0.5}) {
      testing_support::AppendAs<float>(value, false, &bytes);
    }
  }
  EXPECT_EQ(MessageOn(bytes), "nothing was thrown");
}

TEST(BinLayout, SimulatedScansPass) {
  LidarOptions lidar;
  lidar.azimuth_step_deg = 0.72;
  const PointCloud scan = SimulatePair("right_turn", 3, lidar, 2).source;
  std::string bytes;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float record[] = {scan.x[i], scan.y[i], scan.z[i], scan.intensity[i]};
    bytes.append(reinterpret_cast<const char*>(record), sizeof record);
  }
  EXPECT_EQ(MessageOn(bytes), "nothing was thrown");
}

}  // namespace
}  // namespace icpscape
