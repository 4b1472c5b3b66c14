// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/accuracy_table.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "apps/reports/aligned_table.h"
#include "icpscape/common/text.h"
#include "tests/benchmarks/accuracy_methods.h"

namespace icpscape {
namespace {

constexpr double kWorse = 1.1;

using Field = double Attempt::*;
// How the two kinds of errors are printed.
struct Unit {
  Field field;
  const char* name;
  double factor;
  int digits;
};
constexpr Unit kCm = {&Attempt::m, "cm", 100, 2};
constexpr Unit kDeg = {&Attempt::deg, "deg", 1, 3};

std::string Text(double value, const Unit& unit) { return Fixed(unit.factor * value, unit.digits); }

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

long Successes(const MethodAttempts& method) {
  return std::count_if(method.attempts.begin(), method.attempts.end(),
                       [](const Attempt& attempt) { return attempt.Succeeded(); });
}

std::string Of(long some, std::size_t all) {
  return std::to_string(some) + " of " + std::to_string(all);
}

const MethodAttempts& Named(const AccuracySet& set, const std::string& name) {
  return *std::find_if(set.methods.begin(), set.methods.end(),
                       [&](const MethodAttempts& method) { return method.name == name; });
}

std::vector<double> Values(const MethodAttempts& method, Field field, bool of_successes) {
  std::vector<double> values;
  for (const Attempt& attempt : method.attempts) {
    if (!of_successes || attempt.Succeeded()) {
      values.push_back(attempt.*field);
    }
  }
  return values;
}

std::vector<std::string> Row(const MethodAttempts& method) {
  std::vector<std::string> row = {method.name, Of(Successes(method), method.attempts.size())};
  for (const Unit& unit : {kCm, kDeg}) {
    const std::vector<double> errors = Values(method, unit.field, true);
    row.push_back(errors.empty() ? "" : Text(Median(errors), unit));
    row.push_back(errors.empty() ? ""
                                 : Text(*std::max_element(errors.begin(), errors.end()), unit));
  }
  row.push_back(Fixed(1000 * Median(Values(method, &Attempt::seconds, false)), 0));
  return row;
}

void PrintEach(const AccuracySet& set) {
  std::vector<std::vector<std::string>> rows = {{"cm / deg"}};
  rows[0].insert(rows[0].end(), set.names.begin(), set.names.end());
  for (const MethodAttempts& method : set.methods) {
    rows.push_back({method.name});
    for (const Attempt& attempt : method.attempts) {
      rows.back().push_back(Text(attempt.m, kCm) + " / " + Text(attempt.deg, kDeg));
    }
  }
  std::cout << "\n";
  PrintAligned(rows, true);
}

bool PrintBar(const std::string& what, bool met) {
  std::cout << "- " << what << ": " << (met ? "met" : "**missed**") << ".\n";
  return met;
}

bool PrintSuccessBar(const AccuracySet& set) {
  const MethodAttempts& robust = Named(set, kRobustMethod);
  const MethodAttempts* best = nullptr;
  for (const MethodAttempts& method : set.methods) {
    if (method.ours && method.name != kRobustMethod &&
        (best == nullptr || Successes(method) > Successes(*best))) {
      best = &method;
    }
  }
  return PrintBar("Success: robust " + Of(Successes(robust), robust.attempts.size()) +
                      ", the best other of ours (" + best->name + ") " +
                      std::to_string(Successes(*best)),
                  Successes(robust) >= Successes(*best));
}

bool PrintErrorBar(const AccuracySet& set, const Unit& unit, double truth) {
  const MethodAttempts& robust = Named(set, kRobustMethod);
  std::vector<double> ours, best;
  for (std::size_t i = 0; i < robust.attempts.size(); ++i) {
    const Attempt* least = nullptr;
    for (const char* name : {kUngatedMethod, kGatedMethod, kHuberMethod}) {
      const Attempt& attempt = Named(set, name).attempts[i];
      if (attempt.Succeeded() && (least == nullptr || attempt.*unit.field < least->*unit.field)) {
        least = &attempt;
      }
    }
    if (least != nullptr) {
      ours.push_back(robust.attempts[i].*unit.field);
      best.push_back(least->*unit.field);
    }
  }
  if (ours.empty()) {
    return true;
  }
  const double limit = std::max(kWorse * Median(best), truth);
  return PrintBar("Median error where ungated or gated succeeds (" +
                      Of(static_cast<long>(ours.size()), robust.attempts.size()) + "): robust " +
                      Text(Median(ours), unit) + " " + unit.name + ", the best of them " +
                      Text(Median(best), unit) + ", limit " + Text(limit, unit),
                  Median(ours) <= limit);
}

bool PrintFarthestBar(const AccuracySet& set) {
  const std::vector<double> all = Values(Named(set, kRobustMethod), &Attempt::m, false);
  const double most = *std::max_element(all.begin(), all.end());
  return PrintBar(
      "Largest error of all: robust " + Text(most, kCm) + " cm, limit " + Text(set.most_m, kCm),
      most <= set.most_m);
}

}  // namespace

bool PrintAccuracy(const AccuracySet& set) {
  std::cout << "\n## " << set.title << "\n\n";
  std::vector<std::vector<std::string>> rows = {{"method", "success", "median, cm", "largest, cm",
                                                 "median, deg", "largest, deg", "time, ms"}};
  for (const MethodAttempts& method : set.methods) {
    rows.push_back(Row(method));
  }
  PrintAligned(rows, true);
  if (!set.names.empty()) {
    PrintEach(set);
  }
  std::cout << "\n";
  bool all = PrintSuccessBar(set);
  all = PrintErrorBar(set, kCm, set.truth_m) && all;
  all = PrintErrorBar(set, kDeg, set.truth_deg) && all;
  if (set.most_m > 0) {
    all = PrintFarthestBar(set) && all;
  }
  std::cout << std::flush;
  return all;
}

}  // namespace icpscape
