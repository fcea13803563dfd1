#include "report/machine.h"

#include <sys/utsname.h>

#include <cmath>
#include <fstream>
#include <string>
#include <thread>

#include "tyndall/memory.h"

namespace tyndall {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

double memory_gib() { return std::round(static_cast<double>(physical_memory()) / (1 << 30) * 10) / 10; }

std::string system_name() {
  utsname name{};
  if (uname(&name) != 0) return "unknown";
  return std::string(name.sysname) + " " + name.release + " " + name.machine;
}

}  // namespace

nlohmann::ordered_json machine_description(int threads) {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  return {{"cpu", cpu_model()},
          {"threads", threads > 0 ? threads : cores},
          {"memory_gib", memory_gib()},
          {"system", system_name()}};
}

}  // namespace tyndall
