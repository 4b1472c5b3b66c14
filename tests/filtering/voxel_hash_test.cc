// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/voxel_hash.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

using testing::StartsWith;

constexpr char kFrame[] = "its frame";

// The index along an axis that a key holds.
long IndexOf(std::uint64_t key, int axis) {
  return static_cast<long>((key >> (kVoxelBitsPerAxis * (2 - axis))) & 0x1FFFFF) - (1L << 20);
}

void ExpectIndex(float c, double voxel, long index) {
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3f point(0, 0, 0);
    point[axis] = c;
    const std::uint64_t key = VoxelKey(point, voxel, kFrame);
    for (int other = 0; other < 3; ++other) {
      EXPECT_EQ(IndexOf(key, other), other == axis ? index : 0) << c << " m in voxels of " << voxel;
    }
  }
}

TEST(VoxelKey, IsTheIndicesByHand) {
  ExpectIndex(0, 0.5, 0);
  ExpectIndex(0.49F, 0.5, 0);
  ExpectIndex(0.5F, 0.5, 1);
  ExpectIndex(-0.0F, 0.5, 0);
  ExpectIndex(-0.01F, 0.5, -1);
  ExpectIndex(-0.5F, 0.5, -1);
  ExpectIndex(-0.51F, 0.5, -2);
  ExpectIndex(-1e-40F, 0.5, -1);
  ExpectIndex(-1048576, 1, -1048576);
  ExpectIndex(std::nextafter(1048576.F, 0.F), 1, 1048575);
}

TEST(VoxelKey, IsTheFloorOfTheQuotientOnBordersAndBetween) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-100, 100);
  for (const double voxel : {0.1, 0.125, 0.25, 0.3, 1.7}) {
    for (int k = -2000; k < 2000; ++k) {
      const auto border = static_cast<float>(k * voxel);
      for (const float c :
           {border, std::nextafter(border, -1e6F), std::nextafter(border, 1e6F), uniform(random)}) {
        const double index = std::floor(static_cast<double>(c) / voxel);
        ASSERT_EQ(IndexOf(VoxelKey({1, c, -1}, voxel, kFrame), 1), std::lround(index));
      }
    }
  }
}

TEST(VoxelKey, RefusesWhatIsBeyondTheLattice) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float c : {1048576.F, std::nextafter(-1048576.F, -2e6F), 1e30F, kInfinity, -kInfinity,
                        std::nanf("")}) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3f point(0, 0, 0);
      point[axis] = c;
      EXPECT_THROW(VoxelKey(point, 1, kFrame), InputError) << c;
    }
  }
  try {
    VoxelKey({0, -3, 0}, 1e-6, "the target frame");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a point has coordinate -3 m in the target frame; expected it within 2^20 voxels "
                 "of 1e-06 m.");
  }
}

TEST(VoxelNumbers, AreGivenInOrderAndFound) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<std::uint64_t> some(0, 999);
  constexpr std::size_t kMost = 1000;
  VoxelNumbers voxels(kMost);
  std::map<std::uint64_t, std::uint32_t> expected;
  for (int i = 0; i < 5000; ++i) {
    const std::uint64_t key = some(random) << 42 | (i % 7 == 0 ? 0 : 1);
    if (expected.size() < kMost || expected.count(key) != 0) {
      const auto number = static_cast<std::uint32_t>(expected.size());
      EXPECT_EQ(voxels.Insert(key), expected.try_emplace(key, number).first->second);
      EXPECT_EQ(voxels.size(), expected.size());
    }
  }
  EXPECT_EQ(voxels.size(), kMost);
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const std::uint64_t key = (k / 2) << 42 | (k % 2);
    const auto it = expected.find(key);
    EXPECT_EQ(voxels.Find(key), it == expected.end() ? VoxelNumbers::kNone : it->second);
  }
}

TEST(VoxelNumbers, AreNoneWhereNothingIs) {
  EXPECT_EQ(VoxelNumbers(0).Find(0), VoxelNumbers::kNone);
  EXPECT_EQ(VoxelNumbers(0).size(), 0U);
}

TEST(CheckVoxelSize, WantsALength) {
  CheckVoxelSize(1e-300);
  for (const double size : {0., -0.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    try {
      CheckVoxelSize(size);
      ADD_FAILURE() << size;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), StartsWith("voxel_size_m is "));
    }
  }
}

}  // namespace
}  // namespace icpscape
