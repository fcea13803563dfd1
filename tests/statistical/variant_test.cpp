/// What the tests render by default is what users get by default, but that pixels share nothing (measure.h says why) and that
/// no pilot decides on methods.
#include <doctest/doctest.h>

#include "session/image_header.h"
#include "support/measure.h"
#include "support/scene_text.h"
#include "support/strategies.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("a variant that names nothing is the default render, method by method") {
  const Subject subject(view({.look = {0, 0, 1}}) + environment(1));
  RenderSettings defaults;
  defaults.max_depth = subject.scene().settings.max_depth;
  defaults.reuse = ReuseStrategy::off;
  defaults.media = MediaStrategy::product;
  CHECK(options_text(subject.settings()) == options_text(defaults));
  CHECK(subject.settings().threads == defaults.threads);
}

TEST_CASE("lists of strategies hold all that there are") {
  CHECK(every_lights().size() == 8);
  CHECK(every_media().size() == 5);
  CHECK(every_distance().size() == 5);
  CHECK(every_transmittance().size() == 4);
}
