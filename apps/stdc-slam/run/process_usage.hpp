#pragma once

namespace stdc::app {

/// What this process has used so far.
struct ProcessUsage {
  double wall_seconds = 0;    ///< since the process was started, to 0.01 s
  double cpu_seconds = 0;     ///< of all threads, user and system
  double peak_memory_mb = 0;  ///< resident, 10^6 bytes
};

ProcessUsage process_usage();

}  // namespace stdc::app
