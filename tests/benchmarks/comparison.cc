// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/comparison.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace icpscape {
namespace {

bool any_mismatch = false;

double Seconds(const Side& side) {
  const auto start = std::chrono::steady_clock::now();
  side.run();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  return time.count() / side.share;
}

// 0 is the least value, 1 the greatest.
double Quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double part = place - static_cast<double>(below);
  return (1 - part) * values[below] + part * values[above];
}

void Run(const Comparison& comparison, benchmark::State* state) {
  try {
    comparison.ours.run();
    if (comparison.peer.run) {
      comparison.peer.run();
    }
    if (comparison.check) {
      comparison.check();
    }
  } catch (const std::exception& error) {
    any_mismatch = true;
    state->SkipWithError(error.what());
    return;
  }
  std::vector<double> ours, peer, ratio;
  bool ours_first = true;
  for (auto _ : *state) {
    if (!comparison.peer.run) {
      ours.push_back(Seconds(comparison.ours));
    } else {
      double times[2];
      const Side* const sides[2] = {&comparison.ours, &comparison.peer};
      for (const bool second : {false, true}) {
        const int side = ours_first != second ? 0 : 1;
        times[side] = Seconds(*sides[side]);
      }
      ours_first = !ours_first;
      ours.push_back(times[0]);
      peer.push_back(times[1]);
      ratio.push_back(times[1] / times[0]);
    }
    state->SetIterationTime(ours.back());
  }
  state->SetLabel(comparison.title + "|" + comparison.peer.name);
  state->counters["ours_ms"] = 1e3 * Quantile(ours, 0.5);
  if (!ratio.empty()) {
    state->counters["peer_ms"] = 1e3 * Quantile(peer, 0.5);
    state->counters["ratio"] = Quantile(ratio, 0.5);
    state->counters["ratio_q1"] = Quantile(ratio, 0.25);
    state->counters["ratio_q3"] = Quantile(ratio, 0.75);
    state->counters["is_main"] = comparison.is_main ? 1 : 0;
  }
}

}  // namespace

void Register(const Comparison& comparison, int rounds) {
  benchmark::RegisterBenchmark(comparison.name.c_str(),
                               [comparison](benchmark::State& state) { Run(comparison, &state); })
      ->UseManualTime()
      ->Iterations(rounds)
      ->Unit(benchmark::kMillisecond);
}

bool AnyMismatch() { return any_mismatch; }

}  // namespace icpscape
