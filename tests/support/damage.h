/// What a reader may do with damaged copies of files: succeed, or give one clear error.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/mutant.h"

namespace tyndall::test {

/// What a reader made of its mutants.
struct Verdict {
  int cases = 0, accepted = 0, refused = 0;
  int accepted_truncations = 0, accepted_flips = 0;
  double slowest = 0;                   ///< seconds
  std::vector<std::string> complaints;  ///< each breaks the promise; at most 10
  std::string str() const;
};

/// Reads a file; throws Error when it cannot. Anything else that it throws breaks the promise.
using Reader = std::function<void(const std::string& path)>;

/// Writes mutants of the seed files one after another under the name of their seed in a folder of their own, and has
/// each read: 500 of every commit, in the nightly run all truncations of files up to 64 KB (1,000 of larger ones) and
/// 20,000 others. Complains of an error that is not Failure::scene, has more than 3 lines or 1,000 characters or does
/// not name the file; of more than 10 seconds; and of memory beyond 256 MB, here or in a child.
/// TYNDALL_SHOW_MUTANTS=1 tells each on stderr before it is read, to find the one that crashes.
/// Of text seeds, every second mutant has one of its numbers replaced by an extreme one instead of bits flipped.
Verdict read_mutants(const std::vector<std::string>& seeds, const Reader& reader, bool text = false);

}  // namespace tyndall::test
