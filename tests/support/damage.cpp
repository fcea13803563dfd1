#include "support/damage.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "math/hash.h"
#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scratch.h"
#include "tyndall/error.h"

namespace tyndall::test {
namespace {

constexpr int kCasesOfACommit = 500, kNightlyCases = 20000;
constexpr std::size_t kSmall = std::size_t{64} << 10, kCutsOfLarge = 1000;
constexpr double kLongest = 10;           // seconds
constexpr long kMostMemory = 256l << 10;  // KB, beyond what was in use
constexpr std::size_t kMostLines = 3, kMostText = 1000, kMostComplaints = 10;

// The sanitizers keep what was freed for a while, and shadows of everything.
constexpr bool kMemoryCounts = !kSanitized;

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
    if (static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) >= kMostLines)
      return "has too many lines: " + text;
    return "";
  }

  Scratch folder_;
  const Reader& reader_;
  Verdict& verdict_;
};

}  // namespace

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
