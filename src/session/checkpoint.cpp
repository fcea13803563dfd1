#include "session/checkpoint.h"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "math/stream_hash.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr std::string_view kMagic = "Tyndall checkpoint 3\n";
constexpr std::size_t kHashSize = sizeof(std::uint64_t);

std::uint64_t hash_of(std::string_view bytes) {
  StreamHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

class Writer {
 public:
  explicit Writer(std::size_t expected) { bytes_.reserve(expected); }
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  void put_raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  std::string finish() {
    put(hash_of(bytes_));
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

class Reader {
 public:
  Reader(std::string_view rest, const std::string& name) : rest_(rest), name_(name) {}

  [[noreturn]] void fail(const std::string& what) const { throw Error(Failure::scene, name_ + ": " + what); }
  template <typename T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view get_text() { return take(get<std::uint64_t>()); }
  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) fail("is a damaged checkpoint; remove it to begin anew");
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return part;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  const std::string& name_;
};

void put_state(Writer& out, const CheckpointState& state) {
  out.put(state.samples);
  out.put(state.seconds);
  std::apply([&](const auto&... n) { (out.put(static_cast<std::uint64_t>(n)), ...); }, Counters::numbers_of(state.counters));
  out.put(static_cast<std::uint64_t>(state.counters.bad_samples.size()));
  for (const BadSample& bad : state.counters.bad_samples) {
    for (const int n : {bad.x, bad.y, bad.sample}) out.put(n);
  }
}

CheckpointState get_state(Reader& in) {
  CheckpointState state;
  state.samples = in.get<int>();
  state.seconds = in.get<double>();
  if (state.samples < 1 || !(state.seconds >= 0) || !std::isfinite(state.seconds)) in.fail("is a checkpoint of nothing");
  std::apply([&](auto&... n) { ((n = in.get<std::uint64_t>()), ...); }, Counters::numbers_of(state.counters));
  const auto bad = in.get<std::uint64_t>();
  if (bad > kBadSamplesKept) in.fail("is a damaged checkpoint; remove it to begin anew");
  for (std::uint64_t i = 0; i < bad; ++i) {
    const int x = in.get<int>(), y = in.get<int>(), sample = in.get<int>();
    state.counters.bad_samples.push_back({x, y, sample});
  }
  return state;
}

void require_same(Reader& in, const CheckpointIdentity& identity) {
  const auto count = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string_view what = in.get_text(), value = in.get_text();
    if (i >= identity.size() || identity[i].first != what)
      in.fail("is a checkpoint of another version; remove it to begin anew");
    if (identity[i].second != value)
      in.fail("is of another " + identity[i].first + ": " + std::string(value) + " there, " + identity[i].second +
              " here; remove it, or leave out --resume, to begin anew");
  }
  if (count != identity.size()) in.fail("is a checkpoint of another version; remove it to begin anew");
}

}  // namespace

void refuse_checkpoint(const std::string& name) { Reader({}, name).fail("is a damaged checkpoint; remove it to begin anew"); }

std::string encode_checkpoint(const CheckpointIdentity& identity, const CheckpointState& state, const FilmSums& sums) {
  Writer out(sums.memory_bytes() + 4096);
  out.put_raw(kMagic.data(), kMagic.size());
  out.put(static_cast<std::uint64_t>(identity.size()));
  for (const auto& [what, value] : identity) {
    out.put(std::string_view(what));
    out.put(std::string_view(value));
  }
  put_state(out, state);
  out.put(static_cast<std::uint64_t>(sums.size()));
  out.put_raw(sums.high().data(), sums.high().size_bytes());
  out.put_raw(sums.low().data(), sums.low().size_bytes());
  for (const std::uint64_t n : state.plan) out.put(n);
  for (const std::string& layer : state.keyed) out.put(std::string_view(layer));
  return out.finish();
}

namespace {

/// What stands between the magic and the checksum, which fits.
Reader body_of(std::string_view bytes, const std::string& name) {
  const Reader in(bytes, name);
  if (!bytes.starts_with(kMagic)) in.fail("is no checkpoint of this program; name the output that it was made for");
  std::uint64_t stored = 0;
  if (bytes.size() < kMagic.size() + kHashSize) in.fail("is a damaged checkpoint; remove it to begin anew");
  const std::string_view content = bytes.substr(0, bytes.size() - kHashSize);
  std::memcpy(&stored, bytes.data() + content.size(), kHashSize);
  if (stored != hash_of(content))
    in.fail("is a damaged checkpoint: its content does not fit its checksum; remove it to begin anew");

  return {content.substr(kMagic.size()), name};
}

}  // namespace

CheckpointSummary peek_checkpoint(std::string_view bytes, const std::string& name) {
  Reader body = body_of(bytes, name);
  CheckpointSummary summary;
  const auto count = body.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string_view what = body.get_text(), value = body.get_text();
    summary.identity.emplace_back(what, value);
  }
  summary.state = get_state(body);
  return summary;
}

CheckpointState decode_checkpoint(std::string_view bytes, const std::string& name, const CheckpointIdentity& identity,
                                  FilmSums& sums, std::size_t plan_size) {
  Reader body = body_of(bytes, name);
  require_same(body, identity);
  CheckpointState state = get_state(body);
  if (body.get<std::uint64_t>() != sums.size()) body.fail("is a checkpoint of another frame; remove it to begin anew");
  const std::string_view high = body.take(sums.high().size_bytes()), low = body.take(sums.low().size_bytes());
  for (std::size_t i = 0; i < plan_size; ++i) state.plan.push_back(body.get<std::uint64_t>());
  while (!body.at_end()) state.keyed.emplace_back(body.get_text());
  std::memcpy(sums.high().data(), high.data(), high.size());
  std::memcpy(sums.low().data(), low.data(), low.size());
  return state;
}

}  // namespace tyndall
