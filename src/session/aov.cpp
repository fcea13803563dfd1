#include "session/aov.h"

#include <algorithm>

#include "tyndall/error.h"
#include "tyndall/settings.h"

namespace tyndall {

std::string name_of_aov(Aov aov) { return std::string(aov_names()[static_cast<std::size_t>(aov)]); }

std::vector<Aov> parse_aovs(const std::vector<std::string>& names) {
  const auto known = aov_names();
  std::vector<Aov> aovs;
  for (const std::string& name : names) {
    const auto it = std::find(known.begin(), known.end(), name);
    if (it == known.end()) {
      std::string list;
      for (const auto k : known) list += (list.empty() ? "" : ", ") + std::string(k);
      throw Error(Failure::usage, "AOV \"" + name + "\" is not known; choose from " + list);
    }
    aovs.push_back(static_cast<Aov>(it - known.begin()));
  }
  std::sort(aovs.begin(), aovs.end());
  aovs.erase(std::unique(aovs.begin(), aovs.end()), aovs.end());
  return aovs;
}

std::string aov_list(const std::vector<std::string>& names) {
  std::string list;
  for (const Aov aov : parse_aovs(names)) list += (list.empty() ? "" : ",") + name_of_aov(aov);
  return list;
}

}  // namespace tyndall
