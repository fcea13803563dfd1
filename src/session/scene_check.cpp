#include "session/scene_check.h"

namespace tyndall {

void check_values(const Scene& scene) {
  check_view(scene);
  check_looks(scene);
  check_media(scene);
  check_lights(scene);
}

}  // namespace tyndall
