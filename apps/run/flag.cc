// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/flag.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

struct Group {
  std::string title;
  unsigned properties = 0;
};

struct Registry {
  std::map<std::string, Group> groups;         // By file.
  std::map<const void*, unsigned> properties;  // By the address of the flag's value.
};

// Filled before main() begins, in any order of the files.
Registry& TheRegistry() {
  static Registry registry;
  return registry;
}

// As one types it: gflags prints doubles with all 17 digits.
std::string ValueText(const gflags::CommandLineFlagInfo& flag, const std::string& value) {
  if (flag.type != "double") {
    return value;
  }
  std::string text = Number(ParseNumber(value));
  const std::size_t exponent = text.find("e-0");
  return exponent == std::string::npos ? text : text.erase(exponent + 2, 1);  // 1e-4, not 1e-04.
}

bool IsOfMainFile(const Flag& flag) {
  return std::filesystem::path(flag.file).parent_path().filename() == "apps";
}

}  // namespace

FlagGroup::FlagGroup(const char* file, const char* title, unsigned properties) {
  TheRegistry().groups[file] = {title, properties};
}

FlagMark::FlagMark(const void* flag, unsigned properties) {
  TheRegistry().properties[flag] |= properties;
}

std::vector<Flag> OwnFlags() {
  std::vector<gflags::CommandLineFlagInfo> all;
  gflags::GetAllFlags(&all);
  std::vector<Flag> own;
  for (const gflags::CommandLineFlagInfo& info : all) {
    if (info.filename.find("apps/") == std::string::npos) {
      continue;  // gflags, glog and other libraries define flags of their own.
    }
    Group group = {std::string("icpscape-") + std::filesystem::path(info.filename).stem().string(),
                   0};
    const auto found = TheRegistry().groups.find(info.filename);
    if (found != TheRegistry().groups.end()) {
      group = found->second;
    }
    const auto mark = TheRegistry().properties.find(info.flag_ptr);
    const unsigned marked = mark == TheRegistry().properties.end() ? 0U : mark->second;
    own.push_back({info.name, info.type, info.description, info.filename, group.title,
                   ValueText(info, info.current_value), ValueText(info, info.default_value),
                   group.properties | marked});
  }
  std::sort(own.begin(), own.end(), [](const Flag& a, const Flag& b) {
    return std::tuple(!IsOfMainFile(a), a.group, a.name) <
           std::tuple(!IsOfMainFile(b), b.group, b.name);
  });
  return own;
}

std::string TitleWithFlags(const std::string& what, unsigned without) {
  constexpr std::size_t kLineLength = 80;
  std::string title = what;
  for (const Flag& flag : OwnFlags()) {
    if (!flag.IsChanged() || flag.Has(kShown | kAside | without)) {
      continue;
    }
    // Position 0 begins the first line, as one behind a line feed begins another.
    const std::size_t line = title.size() - (title.rfind('\n') + 1);
    const bool fits = line + flag.Text().size() + 2 <= kLineLength;
    title += (fits ? ", " : ",\n") + flag.Text();
  }
  return title;
}

void RequireFlag(bool good, const std::string& flag, const std::string& value,
                 const std::string& expected) {
  if (!good) {
    throw UsageError("--" + flag + "=" + value + ": expected " + expected + ".");
  }
}

double RequireAtLeastZero(const std::string& flag, double value) {
  RequireFlag(value >= 0 && std::isfinite(value), flag, Number(value), "a number of at least 0");
  return value;
}

void RequireUnchanged(const std::function<bool(const Flag&)>& is_of_kind,
                      const std::string& expected) {
  for (const Flag& flag : OwnFlags()) {
    RequireFlag(!flag.IsChanged() || !is_of_kind(flag), flag.name, flag.value, expected);
  }
}

void SetFlagDefault(const std::string& name, const std::string& value) {
  gflags::SetCommandLineOptionWithMode(name.c_str(), value.c_str(), gflags::SET_FLAGS_DEFAULT);
}

}  // namespace icpscape
