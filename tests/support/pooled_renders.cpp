#include "support/pooled_renders.h"

#include <algorithm>
#include <utility>

#include "support/sanitized.h"

namespace tyndall::test {
namespace {

constexpr int kFewest = 8;  // rounds that an error may rest on
/// Samples of one picture: fewer and setting up a render is felt, more and kFewest of them tell more than was asked for.
constexpr int kSamples = kSanitized ? 1024 : 4096;
constexpr int kMostSpp = 16 * 1024;

int most_spp() { return nightly() ? 16 * kMostSpp : kMostSpp; }

/// a + factor b, pixel by pixel.
Image combined(Image a, float factor, const Image& b) {
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    for (std::size_t i = 0; i < a.channels[k].values.size(); ++i) a.channels[k].values[i] += factor * b.channels[k].values[i];
  }
  return a;
}

}  // namespace

PooledRenders::PooledRenders(const std::vector<Contender>& contenders, std::uint64_t first_seed) : seed_(first_seed) {
  for (const Contender& c : contenders) members_.push_back({Subject(c.scene, c.variant), c.times});
  const Scene& scene = members_.front().subject.scene();
  spp_ = std::min(std::max(kSamples / (scene.film.width * scene.film.height), 1), 64);
}

bool PooledRenders::next_round(const Excess& excess, double seconds) {
  bool wanted = rounds_ < kFewest;
  for (Member& m : members_) {
    if (m.renders && rounds_ >= kFewest) m.excess = excess(m.difference.result());
    m.renders = m.excess > 1;
    wanted = wanted || (m.renders && m.seconds < seconds);
  }
  if (!wanted || rounds_ * spp_ >= most_spp()) return false;
  const auto known = std::find_if(members_.begin(), members_.end(), [](const Member& m) { return !m.renders; });
  if (known != members_.end()) known->renders = true;
  render_round();
  return true;
}

double PooledRenders::pooled_mean(int channel) const { return image_mean(pool_.result(), channel).mean; }

Measured PooledRenders::effort(std::size_t i) const {
  Measured m;
  m.renders = members_[i].difference.count();
  m.spp = double(m.renders) * spp_ * members_[i].times;
  m.seconds = members_[i].seconds;
  return m;
}

void PooledRenders::render_round() {
  std::vector<std::pair<Member*, Image>> images;
  for (Member& m : members_) {
    if (!m.renders) continue;
    const double start = processor_seconds();
    images.emplace_back(&m, m.subject.render(spp_ * m.times, seed_));
    m.seconds += processor_seconds() - start;
  }
  ++seed_;
  ++rounds_;
  Image sum = images[0].second;
  for (std::size_t i = 1; i < images.size(); ++i) sum = combined(std::move(sum), 1, images[i].second);
  const auto n = static_cast<float>(images.size());
  pool_.add(combined(sum, 1 / n - 1, sum));
  // x_i less the mean of the others: (n x_i - sum) / (n - 1).
  for (auto& [m, image] : images) m->difference.add(combined(combined(image, n / (n - 1) - 1, image), -1 / (n - 1), sum));
}

}  // namespace tyndall::test
