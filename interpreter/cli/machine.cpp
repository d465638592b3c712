// SPDX-License-Identifier: MIT
#include "cli/machine.h"

#include <stdlib.h>

#include <fstream>
#include <thread>

namespace gmsim::cli {
namespace {

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

Machine this_machine() {
  Machine machine{processor_name(), std::thread::hardware_concurrency(), 0, __VERSION__,
                  GMSIM_BUILD_TYPE};
  double load = 0;
  if (getloadavg(&load, 1) == 1) machine.load = load;
  return machine;
}

}  // namespace gmsim::cli
