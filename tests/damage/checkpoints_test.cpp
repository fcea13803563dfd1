/// Damaged checkpoints: every one is refused.
#include <doctest/doctest.h>

#include "support/damage.h"
#include "support/scratch.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("damaged checkpoints") {
  const std::string text =
      "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 6 WorldBegin LightSource \"infinite\"";
  const World world = build(read_scene_text(text, "test.pbrt").scene, {.threads = 1});
  RenderJob job(world, {.threads = 1});
  job.advance(2);
  const Scratch folder;
  write_bytes(folder / "a.checkpoint", job.save());
  const auto resume = [&](const std::string& path) {
    RenderJob other(world, {.threads = 1});
    other.restore(read_file(path), path);
  };
  resume(folder / "a.checkpoint");
  const Verdict verdict = read_mutants({folder / "a.checkpoint"}, resume);
  MESSAGE(verdict.str());
  CHECK(verdict.complaints.empty());
  CHECK(verdict.accepted == 0);
}
