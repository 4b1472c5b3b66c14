// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/registry.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace icpscape {
namespace {

// True if the residual test suite is instantiated for M in this program.
template <class M>
bool HasSuite() {
  const std::string wanted = testing::internal::GetTypeName<M>();
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    if (std::string(suite.name()).find("/ResidualTest/") != std::string::npos &&
        suite.type_param() != nullptr && suite.type_param() == wanted) {
      return true;
    }
  }
  return false;
}

struct NotTested {};

TEST(Registry, EveryMetricHasTheResidualTestSuite) {
  ForEachMetric([](auto tag) {
    using Metric = typename decltype(tag)::Metric;
    EXPECT_TRUE(HasSuite<Metric>())
        << Metric::kName << " is registered but tests/residuals/ has no "
        << "INSTANTIATE_TYPED_TEST_SUITE_P for it";
  });
  EXPECT_FALSE(HasSuite<NotTested>()) << "the search above finds what is not there";
}

TEST(Registry, NamesAreUniqueAndFound) {
  std::set<std::string> names;
  ForEachMetric([&](auto tag) {
    using Metric = typename decltype(tag)::Metric;
    EXPECT_TRUE(names.insert(Metric::kName).second) << Metric::kName;
    bool same = false;
    EXPECT_TRUE(WithMetric(Metric::kName, [&](auto found) {
      same = std::is_same_v<Metric, typename decltype(found)::Metric>;
    }));
    EXPECT_TRUE(same);
  });
  EXPECT_GE(names.size(), 6U);
  EXPECT_FALSE(WithMetric("point_to_pint", [](auto) {}));
}

}  // namespace
}  // namespace icpscape
