/// A suite of regression images: a folder of scenes, each with settings and a reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tyndall {

/// One scene of a suite: NAME.pbrt, its settings NAME.json (may be absent: the defaults below) and its reference NAME.exr.
struct RegressCase {
  std::string name;
  std::string about{};                 ///< what the scene is there for, one line
  int spp = 64;                        ///< samples a pixel of one run, >= 1
  int runs = 4;                        ///< independent runs of a test, >= 2: their spread is its variance
  int reference_runs = 16;             ///< independent runs behind the reference, >= 2
  std::vector<std::string> aovs{};     ///< channels tested besides R G B A
  std::uint64_t seed = 0;              ///< added to --seed; the bytes are rendered with this one alone
  bool bytes = false;                  ///< a --reproducible render must equal NAME.bytes.exr byte for byte
  double timeout = 60;                 ///< seconds that one run may take
  std::vector<std::string> options{};  ///< further options of `tyndall render`
  std::string fault{};                 ///< what is wrong with its files; such a case cannot be rendered. "": nothing
};

struct RegressSuite {
  std::string folder;
  std::vector<RegressCase> cases;  ///< by name

  std::string reference_path(const RegressCase& c) const { return folder + "/" + c.name + ".exr"; }
  std::string bytes_path(const RegressCase& c) const { return folder + "/" + c.name + ".bytes.exr"; }
};

/// Reads the folder and every settings file in it. Throws Error (scene) for a folder without scenes. Settings that cannot
/// be understood (an unknown key, say) or belong to no scene are the `fault` of a case by their name.
RegressSuite read_suite(const std::string& folder);

/// Indices of the cases whose name matches `filter`: a glob when it has * ? or [, else a part of the name; "": all.
/// Throws Error (usage) that lists the names when there is none.
std::vector<std::size_t> select_cases(const RegressSuite& suite, const std::string& filter);

}  // namespace tyndall
