// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_FLAG_H_
#define ICPSCAPE_APPS_RUN_FLAG_H_

#include <functional>
#include <string>
#include <vector>

namespace icpscape {

/// What is to be known about a flag beyond its value. A flag without any of these changes results,
/// and a picture does not show its value: the picture's title names it.
enum FlagProperty : unsigned {
  /// A picture shows it: in the name of the data, in the legend or along the axes.
  kShown = 1U << 0U,
  /// No result depends on it: threads, folders, what is written besides.
  kAside = 1U << 1U,
  /// It changes the cost and what is minimised, and leaves the paper's RMSE as it is.
  kCostOnly = 1U << 2U,
  /// It prepares a pair of scans. Simulated Monte-Carlo draws are not prepared by it.
  kNotOfDraws = 1U << 3U,
};

/// One group of flags is one file. An object of this class in the file gives the group its title,
/// and gives properties to all flags of the file:
///   static const icpscape::FlagGroup group(__FILE__, "Simulated lidar");
/// A file without a group gets the name of the program as title.
struct FlagGroup {
  FlagGroup(const char* file, const char* title, unsigned properties = 0);
};

/// Gives properties to one flag. Put it beside the flag's definition:
///   static const icpscape::FlagMark seed_mark(&FLAGS_seed, icpscape::kShown);
struct FlagMark {
  FlagMark(const void* flag, unsigned properties);
};

/// A flag of this program.
struct Flag {
  std::string name, type, help;
  std::string file, group;
  std::string value, default_value;  ///< Numbers as one types them: 0.004.
  unsigned properties = 0;

  bool Has(unsigned property) const { return (properties & property) != 0; }
  bool IsChanged() const { return value != default_value; }
  /// "--name=value".
  std::string Text() const { return "--" + name + "=" + value; }
};

/// All flags of this program, without those of libraries: first those of its main file, then group
/// by group.
std::vector<Flag> OwnFlags();

/// A figure's title: `what`, and every changed flag that the figure does not show, as in
/// "KITTI 00, --octree_voxel_m=0.1". Flags with one of the properties `without` are left out. Long
/// titles have several lines.
std::string TitleWithFlags(const std::string& what, unsigned without = 0);

/// Throws UsageError "--flag=value: expected ..." unless good.
void RequireFlag(bool good, const std::string& flag, const std::string& value,
                 const std::string& expected);

/// The value. Throws UsageError unless it is finite and at least 0.
double RequireAtLeastZero(const std::string& flag, double value);

/// Throws UsageError for the first flag of this kind that is changed.
void RequireUnchanged(const std::function<bool(const Flag&)>& is_of_kind,
                      const std::string& expected);

/// Changes the default of a flag, and with it the value, unless the command line gives one.
void SetFlagDefault(const std::string& name, const std::string& value);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_FLAG_H_
