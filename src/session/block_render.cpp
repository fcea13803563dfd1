#include "session/block_render.h"

namespace tyndall {

void BlockRender::render(PixelPlace corner, const PixelBounds& tile, SampleSpan samples, const Scratch& scratch) const {
  if (shared_.context.settings.reuse != ReuseStrategy::pixels)
    return render_apart(PixelBlock(corner.x, corner.y, tile), samples, scratch);
  render_shared(PixelBlock(corner.x, corner.y, frame_of(shared_.context.world.built.scene.film)), samples, scratch);
}

SampleKey BlockRender::key_of(PixelPlace p, int sample) const {
  return {shared_.context.settings.seed, p.x, p.y, shared_.first_sample + sample};
}

void BlockRender::render_apart(const PixelBlock& block, SampleSpan samples, const Scratch& scratch) const {
  for (const PixelPlace p : block.pixels()) {
    const PixelFilm film = shared_.searched.of(p);
    for (int s = samples.begin; s < samples.end; ++s) {
      scratch.group.clear();
      scratch.group.add(shared_.context, key_of(p, s), film, scratch.counters);
      add_to_film(scratch, samples.share);
    }
  }
}

/// Whoever shares with a pixel that is rendered has its path as well, so that a crop has the same bits.
void BlockRender::render_shared(const PixelBlock& block, SampleSpan samples, const Scratch& scratch) const {
  const auto pixels = block.pixels();
  const std::vector<PixelFilm> films = shared_.searched.of(block);
  for (int s = samples.begin; s < samples.end; ++s) {
    scratch.group.clear();
    for (std::size_t i = 0; i < pixels.size(); ++i)
      scratch.group.add(shared_.context, key_of(pixels[i], s), films[i], scratch.counters);
    add_to_film(scratch, samples.share);
  }
}

void BlockRender::add_to_film(const Scratch& scratch, float share) const {
  auto& [group, counters] = scratch;
  FilmBuffer& film = shared_.film;
  group.run(shared_.context, counters);
  for (std::size_t i = 0; i < group.size(); ++i) {
    PixelSample& sample = group[i];
    const SampleKey& key = sample.key();
    if (!film.crop().contains(key.x, key.y)) continue;
    PathRecord record = sample.record();
    std::span<const Rgb> groups = sample.by_group();
    const bool finite = record.is_finite();
    if (!finite) {
      ++counters.non_finite;
      counters.bad_samples.push_back({key.x, key.y, key.sample});
      if (counters.bad_samples.size() > 4 * kBadSamplesKept) counters.trim_bad_samples();
      record = PathRecord();
      record.alpha = 0;
      groups = {};
    }
    const FilmBuffer::SamplePlace at{key.x, key.y, key.sample, share};
    film.add(at, record, sample.weight());
    if (!groups.empty()) film.add_groups(at, record.radiance(), groups, sample.weight());
    if (finite) add_seen(sample, at);
  }
}

void BlockRender::add_seen(const PixelSample& sample, const FilmBuffer::SamplePlace& at) const {
  if (sample.matte()) shared_.mattes.add(shared_.film, at, *sample.matte(), sample.weight());
  shared_.film.add_deep(at, sample.by_depth(), sample.weight());
}

}  // namespace tyndall
