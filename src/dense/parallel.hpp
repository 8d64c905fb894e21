#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace stdc {

/// Threads to use where 0 is given: one for each core, within reason.
inline int threads_or_cores(int threads) {
  if (threads > 0) return threads;
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 16);
}

/// Calls body(begin, end) for parts of [0, count) that make up the whole, on so many threads at once. What a
/// body throws is thrown here.
template <typename Body>
void parallel_for(std::size_t count, int threads, const Body& body) {
  const std::size_t parts = std::min(count, static_cast<std::size_t>(std::max(1, threads)));
  if (parts <= 1) {
    if (count > 0) body(std::size_t{0}, count);
    return;
  }
  std::exception_ptr fault;
  std::mutex mutex;
  const auto guarded = [&](std::size_t part) {
    try {
      body(part * count / parts, (part + 1) * count / parts);
    } catch (...) {
      const std::lock_guard lock(mutex);
      fault = std::current_exception();
    }
  };
  std::vector<std::thread> workers;
  workers.reserve(parts - 1);
  for (std::size_t part = 1; part < parts; ++part) workers.emplace_back(guarded, part);
  guarded(0);
  for (std::thread& worker : workers) worker.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace stdc
