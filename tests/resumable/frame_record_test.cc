// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/resumable/frame_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "icpscape/common/text.h"
#include "tests/support/message_of.h"

namespace icpscape {
namespace {

using testing_support::MessageOf;

// Bit for bit: 0 and -0 differ, NaN equals itself.
bool SameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void ExpectSamePose(const SE3d& a, const SE3d& b) {
  for (Eigen::Index i = 0; i < 9; ++i) {
    EXPECT_TRUE(SameBits(a.R().data()[i], b.R().data()[i]));
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_TRUE(SameBits(a.t()[i], b.t()[i]));
  }
}

void ExpectSame(const FrameRecord& a, const FrameRecord& b) {
  EXPECT_EQ(a.scan_sha256, b.scan_sha256);
  EXPECT_TRUE(SameBits(a.read_s, b.read_s));
  EXPECT_TRUE(SameBits(a.odometry_s, b.odometry_s));
  EXPECT_EQ(a.result.registered, b.result.registered);
  EXPECT_EQ(a.result.recovered, b.result.recovered);
  EXPECT_EQ(a.result.deskewed, b.result.deskewed);
  EXPECT_EQ(a.result.termination, b.result.termination);
  EXPECT_EQ(a.result.converged, b.result.converged);
  EXPECT_EQ(a.result.predicted_directions, b.result.predicted_directions);
  EXPECT_EQ(a.result.uncertain_directions, b.result.uncertain_directions);
  EXPECT_EQ(a.result.iterations, b.result.iterations);
  EXPECT_EQ(a.result.n, b.result.n);
  EXPECT_TRUE(SameBits(a.result.rmse, b.result.rmse));
  EXPECT_TRUE(SameBits(a.result.gate_m, b.result.gate_m));
  EXPECT_EQ(a.result.points, b.result.points);
  EXPECT_EQ(a.result.map_points, b.result.map_points);
  ExpectSamePose(a.result.T_world_lidar, b.result.T_world_lidar);
  ExpectSamePose(a.result.motion, b.result.motion);
}

// No two numbers alike.
FrameRecord Example() {
  FrameRecord record;
  record.scan_sha256 = "00ff";
  record.read_s = 0.125;
  record.odometry_s = 0.1;
  record.result.registered = true;
  record.result.recovered = true;
  record.result.deskewed = true;
  record.result.termination = Termination::kNoDescent;
  record.result.converged = true;
  record.result.predicted_directions = 2;
  record.result.uncertain_directions = 3;
  record.result.iterations = 7;
  record.result.n = 123456;
  record.result.rmse = 0.03125;
  record.result.gate_m = 1.5;
  record.result.points = 9000;
  record.result.map_points = 40000;
  record.result.T_world_lidar = SE3d::Exp((Vec6() << 0.1, 0.2, 0.3, 1, -20, 300).finished());
  record.result.motion = SE3d::Exp((Vec6() << 1e-9, -1e-5, 3, 0.7, 0.08, -0.009).finished());
  return record;
}

TEST(FrameRecord, ReadsBackBitForBit) {
  ExpectSame(ParseFrameRecord(FormatFrameRecord(Example()), ""), Example());
  FrameRecord first;
  first.scan_sha256 = "00";
  ExpectSame(ParseFrameRecord(FormatFrameRecord(first), ""), first);
  std::mt19937_64 engine(1);
  for (int i = 0; i < 300; ++i) {
    const auto any = [&] {  // All doubles that are finite, tiny ones and -0 among them.
      double value = 0;
      do {
        const std::uint64_t bits = engine();
        std::memcpy(&value, &bits, sizeof value);
      } while (!std::isfinite(value));
      return i % 10 == 0 ? -0.0 : value;
    };
    FrameRecord record = Example();
    record.result.rmse = any();
    record.read_s = any();
    Mat3 R;
    std::generate(R.data(), R.data() + 9, any);
    record.result.T_world_lidar = SE3d(R, Vec3(any(), any(), any()));
    record.result.termination = static_cast<Termination>(i % 8);
    record.result.registered = i % 2 == 0;
    record.result.points = (std::size_t{1} << 53U) - static_cast<std::size_t>(i);
    ExpectSame(ParseFrameRecord(FormatFrameRecord(record), ""), record);
  }
}

// The RMSE over no pairs is NaN.
TEST(FrameRecord, ReadsBackNan) {
  FrameRecord record = Example();
  record.result.rmse = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(ParseFrameRecord(FormatFrameRecord(record), "").result.rmse));
}

TEST(FrameRecord, RefusesGarbage) {
  const std::string good = FormatFrameRecord(Example());
  const std::vector<std::string> words = Split(good, ' ');
  ASSERT_EQ(words.size(), 1U + 15U + 12U + 12U);
  const auto refused = [](const std::string& text) {
    return MessageOf([&] { ParseFrameRecord(text, "the place"); }) ==
           "the place: no record of a scan; expected a journal of an odometry.";
  };
  EXPECT_TRUE(refused(""));
  EXPECT_TRUE(refused("garbage"));
  EXPECT_TRUE(refused(good + " 1"));
  for (std::size_t i = 1; i < words.size(); ++i) {
    for (const char* bad : {"x", "1x", "inf", "-inf"}) {
      std::vector<std::string> changed = words;
      changed[i] = bad;
      EXPECT_TRUE(refused(Join(changed, " "))) << i << " " << bad;
    }
    std::vector<std::string> shorter = words;
    shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_TRUE(refused(Join(shorter, " "))) << i;
  }
  for (std::size_t i = 16; i < words.size(); ++i) {  // Poses.
    std::vector<std::string> changed = words;
    changed[i] = "nan";
    EXPECT_TRUE(refused(Join(changed, " "))) << i;
  }
  // All but rmse, gate_m and the times.
  for (const std::size_t i : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 12U, 13U}) {
    for (const char* bad : {"nan", "0.5", "-1", "1e300"}) {
      std::vector<std::string> changed = words;
      changed[i] = bad;
      EXPECT_TRUE(refused(Join(changed, " "))) << i << " " << bad;
    }
  }
  std::vector<std::string> changed = words;
  changed[1] = "2";  // Neither false nor true.
  EXPECT_TRUE(refused(Join(changed, " ")));
  changed = words;
  changed[4] = "9";  // There are nine terminations.
  EXPECT_TRUE(refused(Join(changed, " ")));
  EXPECT_FALSE(refused(good));
}

}  // namespace
}  // namespace icpscape
