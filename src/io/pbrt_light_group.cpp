#include "io/pbrt_light_group.h"

#include "io/pbrt_suggest.h"
#include "tyndall/lights.h"

namespace tyndall::pbrt {

std::string read_light_group(ParamList& params) {
  std::string group = params.string("lightgroup", "");
  if (params.find("lightgroup", {ParamType::string}) && !is_light_group_name(group))
    throw params.error("lightgroup", "light group \"" + printable(group) +
                                         "\" cannot name channels of an image; use 1 to 64 letters, digits, - and _");
  return group;
}

}  // namespace tyndall::pbrt
