// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COMMON_PARALLEL_H_
#define ICPSCAPE_SRC_COMMON_PARALLEL_H_

#include <cstddef>
#include <functional>

namespace icpscape {

/// Number of hardware threads.
int HardwareThreads();

/// Calls body(i) for i in [0, count) on at most `threads` threads; 1 runs in order on the caller's.
/// Work that sums must write one result per i and add them up afterwards in order of i: then the
/// result does not depend on the number of threads. The first exception is rethrown.
void ParallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

/// Splits [0, count) into parts of kPartSize, whatever the number of threads, and calls
/// body(begin, end) for each.
constexpr std::size_t kPartSize = 2048;
void ForEachPart(std::size_t count, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COMMON_PARALLEL_H_
