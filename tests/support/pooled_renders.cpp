#include "support/pooled_renders.h"

#include <utility>

#include "support/sanitized.h"

namespace tyndall::test {
namespace {

constexpr int kSpp = kSanitized ? 1 : 8, kFewest = 8;
constexpr std::size_t kStay = 2;

int most_rounds() { return nightly() ? 16 * 2048 : 2048; }

/// a + factor b, pixel by pixel.
Image combined(Image a, float factor, const Image& b) {
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    for (std::size_t i = 0; i < a.channels[k].values.size(); ++i) a.channels[k].values[i] += factor * b.channels[k].values[i];
  }
  return a;
}

}  // namespace

PooledRenders::PooledRenders(const std::vector<Contender>& contenders, std::uint64_t first_seed) : seed_(first_seed) {
  for (const Contender& c : contenders) members_.push_back({Subject(c.scene, c.variant)});
}

bool PooledRenders::next_round(const std::function<bool(const MeanImage& difference)>& known, double seconds) {
  bool any = rounds_ < kFewest;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& m = members_[i];
    m.known = rounds_ >= kFewest && known(difference(i));
    any = any || (!m.known && m.seconds < seconds);
  }
  if (!any || rounds_ >= most_rounds()) return false;
  render_round();
  return true;
}

double PooledRenders::pooled_mean(int channel) const { return image_mean(pool_.result(), channel).mean; }

Measured PooledRenders::effort(std::size_t i) const {
  Measured m;
  m.renders = members_[i].difference.count();
  m.spp = double(m.renders) * kSpp;
  m.seconds = members_[i].seconds;
  return m;
}

void PooledRenders::render_round() {
  std::vector<std::pair<Member*, Image>> images;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& m = members_[i];
    if (m.known && i >= kStay) continue;
    const double start = processor_seconds();
    images.emplace_back(&m, m.subject.render(kSpp, seed_));
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
