/// The machine that figures were measured on.
#pragma once

#include <nlohmann/json.hpp>

namespace tyndall {

/// {"cpu", "threads", "memory_gib", "system"}, as far as the system tells.
nlohmann::ordered_json machine_description(int threads);

}  // namespace tyndall
