// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/verdict.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/output.h"

namespace icpscape {
namespace {

constexpr double kMillidegrees = 1000 * 180 / M_PI;
constexpr std::array<const char*, 6> kAxes = {"roll", "pitch", "yaw", "x", "y", "z"};

void AddRows(const NamedVerdict& named, Table* table) {
  const Verdict& verdict = named.second;
  const auto add = [&](const char* axis, const std::string& words, const char* status,
                       double deviation, const char* unit, const Vec6& direction) {
    std::vector<std::string> row = {named.first, axis, words, status, Number(deviation), unit};
    for (const double component : direction) {
      row.push_back(Number(component));
    }
    table->AddRow(std::move(row));
  };
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    const double deviation = verdict.deviation[axis];
    add("1", kAxes[static_cast<std::size_t>(axis)],
        std::isnan(deviation) ? "undetermined" : "determined", deviation, axis < 3 ? "rad" : "m",
        Vec6::Unit(axis));
  }
  for (const UndeterminedDirection& one : verdict.undetermined) {
    add("0", Join(Split(one.name), ""), NameOf(one.cause), NAN, "none", one.direction);
  }
}

}  // namespace

void PrintVerdict(const Verdict& verdict) {
  std::printf("verdict: %s\n", verdict.Text().c_str());
  if (!verdict.HasPose()) {
    return;
  }
  std::printf("predicted deviation:");
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    const double deviation = verdict.deviation[axis] * (axis < 3 ? kMillidegrees : 1000);
    std::printf("%s %s %s", axis == 0 ? "" : ",", kAxes[static_cast<std::size_t>(axis)],
                std::isnan(deviation)
                    ? "undetermined"
                    : (Fixed(deviation, 1) + (axis < 3 ? " mdeg" : " mm")).c_str());
  }
  std::printf("\n");
}

void WriteVerdicts(const std::vector<NamedVerdict>& verdicts, Run* run) {
  Table table({"name", "is_axis", "direction", "status", "deviation", "unit", "direction_rx",
               "direction_ry", "direction_rz", "direction_tx", "direction_ty", "direction_tz"});
  Manifest* const manifest = run->manifest();
  for (const NamedVerdict& named : verdicts) {
    const Verdict& verdict = named.second;
    const std::string suffix = verdicts.size() == 1 ? "" : "_" + named.first;
    manifest->SetResult("verdict" + suffix, verdict.Text());
    manifest->SetResult("undetermined" + suffix, Join(verdict.UndeterminedNames()));
    manifest->SetResult("converged" + suffix, verdict.converged ? "yes" : "no");
    manifest->SetResult("matched_share" + suffix, verdict.matched_share);
    AddRows(named, &table);
  }
  table.WriteCsv(run->File("verdict.csv"));
}

bool AcceptedVerdicts::Accept(const Verdict& verdict) const {
  const bool is_cycle = verdict.termination == Termination::kLimitCycle;
  return verdict.HasPose() && (verdict.Determined() || undetermined) &&
         (verdict.converged || (is_cycle ? cycle : limit));
}

void RequireAccepted(const std::vector<NamedVerdict>& verdicts, const AcceptedVerdicts& accepted) {
  std::vector<std::string> doubtful;
  for (const auto& [name, verdict] : verdicts) {
    if (!accepted.Accept(verdict)) {
      doubtful.push_back(name + ": " + verdict.Text());
    }
  }
  if (!doubtful.empty()) {
    throw DoubtfulPose(Join(doubtful, "; ") +
                       ". The results are written; --accept takes such a pose.");
  }
}

}  // namespace icpscape
