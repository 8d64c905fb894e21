#include "run/process_usage.hpp"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace stdc::app {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Field 22 of /proc/self/stat: clock ticks from boot to the start of the process.
double seconds_since_start() {
  std::ifstream file("/proc/self/stat");
  std::string text;
  std::getline(file, text);
  // The second field, the name, may hold blanks; it ends with the last bracket.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string field;
  for (int i = 3; i <= 22; ++i) fields >> field;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const double uptime = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  const double started = std::atof(field.c_str()) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return field.empty() ? 0 : uptime - started;
}

/// VmHWM of /proc/self/status [kB]. getrusage's maximum is not used because it counts the parent's memory
/// from before exec.
double peak_kilobytes() {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word) {
    double value = 0;
    if (word == "VmHWM:" && file >> value) return value;
  }
  return 0;
}

}  // namespace

ProcessUsage process_usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr double kMegabytesPerKilobyte = 1024 / 1e6;
  return {seconds_since_start(), seconds(usage.ru_utime) + seconds(usage.ru_stime),
          peak_kilobytes() * kMegabytesPerKilobyte};
}

}  // namespace stdc::app
