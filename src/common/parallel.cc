// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/common/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <thread>

namespace icpscape {

int HardwareThreads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void ParallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) {
      body(i);
    }
    return;
  }
  // Without this TBB warns about, and ignores, more threads than the machine has.
  static const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 1024);
  // An arena per call: `threads` is a property of the call, and the workers sleep in between.
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t i = range.begin(); i != range.end(); ++i) {
                          body(i);
                        }
                      });
  });
}

void ForEachPart(std::size_t count, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
  ParallelFor((count + kPartSize - 1) / kPartSize, threads, [&](std::size_t part) {
    body(part * kPartSize, std::min(count, (part + 1) * kPartSize));
  });
}

}  // namespace icpscape
