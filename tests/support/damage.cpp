#include "support/damage.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "math/hash.h"
#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scratch.h"
#include "tyndall/error.h"

namespace tyndall::test {
namespace {

constexpr int kCasesOfACommit = 500, kNightlyCases = 20000;
constexpr std::size_t kSmall = std::size_t{64} << 10, kCutsOfLarge = 1000;
constexpr double kLongest = 10;                        // seconds
constexpr long kMostMemory = 256l << 10;               // KB, beyond what was in use
constexpr std::size_t kMostLines = 3, kMostText = 1000, kMostComplaints = 10;

// The sanitizers keep what was freed for a while, and shadows of everything.
constexpr bool kMemoryCounts = !kSanitized;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t bits() { return hash(seed_, count_++); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % std::max<std::size_t>(n, 1)); }

 private:
  std::uint64_t seed_, count_ = 0;
};

Mutant with_flips(const std::string& bytes, Draw& draw) {
  Mutant m{Damage::bit_flips, bytes, "bits flipped:"};
  const std::size_t count = draw.below(2) == 0 ? 1 : 1 + draw.below(8);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = draw.below(bytes.size()), bit = draw.below(8);
    m.bytes[at] = static_cast<char>(m.bytes[at] ^ (1 << bit));
    m.how += " " + std::to_string(at) + "." + std::to_string(bit);
  }
  return m;
}

Mutant with_number(const std::string& bytes, Draw& draw) {
  const std::size_t size = std::min(std::size_t{1} << draw.below(4), bytes.size());
  const std::size_t at = draw.below(bytes.size() - size + 1);
  std::uint64_t old = 0, value = 0;
  std::memcpy(&old, bytes.data() + at, size);
  const std::uint64_t top = std::uint64_t{1} << (8 * size - 1);
  const std::uint64_t choices[] = {0, 1, ~std::uint64_t{0}, top - 1, top, old + 1, old - 1, 2 * old, top >> 1, draw.bits(), draw.bits() >> draw.below(64)};
  value = choices[draw.below(std::size(choices))];
  Mutant m{Damage::overwrite, bytes, std::to_string(size) + " bytes at " + std::to_string(at) + " set to " + std::to_string(value)};
  std::memcpy(m.bytes.data() + at, &value, size);
  return m.bytes == bytes ? with_flips(bytes, draw) : m;
}

/// One number in the text, found from a random place on, becomes one that geometry and optics stumble over.
Mutant with_text_number(const std::string& bytes, Draw& draw) {
  static const char* const kNumbers[] = {"0", "-1", "1e-38", "1e-30", "1e-10", "1e10", "1e30", "3e38", "-1e30", "1e39", "nan", "0.9999999",
                                         "65535", "2147483647", "-2147483648", "1e-45", "1000", "-0", "90", "180"};
  std::size_t begin = draw.below(bytes.size());
  begin = bytes.find_first_of("0123456789", begin);
  if (begin == std::string::npos) begin = bytes.find_first_of("0123456789");
  if (begin == std::string::npos) return with_flips(bytes, draw);
  while (begin > 0 && std::string("0123456789.-+e").find(bytes[begin - 1]) != std::string::npos) --begin;
  const std::size_t end = std::min(bytes.find_first_not_of("0123456789.-+e", begin), bytes.size());
  const std::string number = kNumbers[draw.below(std::size(kNumbers))];
  return {Damage::number, bytes.substr(0, begin) + number + bytes.substr(end), "number at " + std::to_string(begin) + " set to " + number};
}

long peak_kilobytes(int who) {
  rusage usage{};
  getrusage(static_cast<__rusage_who_t>(who), &usage);
  return usage.ru_maxrss;
}

class Trial {
 public:
  Trial(const Reader& reader, Verdict& verdict) : reader_(reader), verdict_(verdict) {}

  void read(const std::string& seed, const Mutant& mutant) {
    const std::string name = std::filesystem::path(seed).filename().string(), path = folder_ / name;
    write_bytes(path, mutant.bytes);
    if (std::getenv("TYNDALL_SHOW_MUTANTS")) std::fprintf(stderr, "%s: %s\n", name.c_str(), mutant.how.c_str());
    const auto start = std::chrono::steady_clock::now();
    bool accepted = false;
    std::string complaint;
    try {
      reader_(path);
      accepted = true;
    } catch (const Error& e) {
      complaint = fault_of(e, name);
    } catch (const std::exception& e) {
      complaint = std::string("threw something else: ") + e.what();
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    verdict_.slowest = std::max(verdict_.slowest, seconds);
    if (seconds > kLongest) complaint = "took " + std::to_string(seconds) + " s";
    ++verdict_.cases;
    ++(accepted ? verdict_.accepted : verdict_.refused);
    if (accepted && mutant.damage == Damage::truncation) ++verdict_.accepted_truncations;
    if (accepted && mutant.damage == Damage::bit_flips) ++verdict_.accepted_flips;
    if (!complaint.empty() && verdict_.complaints.size() < kMostComplaints)
      verdict_.complaints.push_back(name + ", " + mutant.how + ": " + complaint);
  }

 private:
  static std::string fault_of(const Error& e, const std::string& name) {
    const std::string text = e.what();
    if (e.failure() != Failure::scene) return "not a scene failure: " + text;
    if (text.find(name) == std::string::npos) return "does not name the file: " + text;
    if (text.size() > kMostText) return "is too long: " + text.substr(0, kMostText);
    if (static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) >= kMostLines) return "has too many lines: " + text;
    return "";
  }

  Scratch folder_;
  const Reader& reader_;
  Verdict& verdict_;
};

Mutant cut(const std::string& bytes, std::size_t size) {
  return {Damage::truncation, bytes.substr(0, size), "cut to " + std::to_string(size) + " bytes"};
}

}  // namespace

Mutant mutant_of(const std::string& bytes, Damage damage, std::uint64_t seed) {
  Draw draw(seed);
  if (damage == Damage::truncation || bytes.empty()) return cut(bytes, draw.below(bytes.size()));
  if (damage == Damage::number) return with_text_number(bytes, draw);
  return damage == Damage::bit_flips ? with_flips(bytes, draw) : with_number(bytes, draw);
}

Verdict read_mutants(const std::vector<std::string>& seeds, const Reader& reader, bool text) {
  Verdict verdict;
  Trial trial(reader, verdict);
  const long before = peak_kilobytes(RUSAGE_SELF);
  const int cases = (nightly() ? kNightlyCases : kCasesOfACommit) / static_cast<int>(seeds.size());
  for (const std::string& seed : seeds) {
    const std::string bytes = read_bytes(seed);
    const std::uint64_t stream = hash(base_seed(), hash(bytes.size(), verdict.cases));
    for (int i = 0; i < cases; ++i) {
      // The nightly run has its own, complete list of cuts.
      Damage damage = nightly() ? Damage{i / 2 % 2 + 1} : Damage{i % 3};
      if (text && i % 2 == 0) damage = Damage::number;
      trial.read(seed, mutant_of(bytes, damage, hash(stream, static_cast<std::uint64_t>(i))));
    }
    if (!nightly()) continue;
    const std::size_t step = bytes.size() <= kSmall ? 1 : bytes.size() / kCutsOfLarge;
    for (std::size_t size = 0; size < bytes.size(); size += step) trial.read(seed, cut(bytes, size));
  }
  const long here = peak_kilobytes(RUSAGE_SELF) - before, child = peak_kilobytes(RUSAGE_CHILDREN) - before;
  if (kMemoryCounts && std::max(here, child) > kMostMemory)
    verdict.complaints.push_back("memory rose by " + std::to_string(here >> 10) + " MB here and to " +
                                 std::to_string(child >> 10) + " MB more in a child");
  return verdict;
}

std::string Verdict::str() const {
  std::string text = std::to_string(cases) + " damaged files: " + std::to_string(refused) + " refused, " +
                     std::to_string(accepted) + " read (" + std::to_string(accepted_truncations) + " cut, " +
                     std::to_string(accepted_flips) + " with flipped bits); slowest " + std::to_string(slowest) + " s";
  for (const std::string& complaint : complaints) text += "\n  " + complaint;
  return text;
}

}  // namespace tyndall::test
