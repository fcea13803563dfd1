/// A render on many machines, told without the words of any engine that runs it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace tyndall {

/// A word of a command. What `is_template` may hold {program}, {scene}, {folder}, {output}, {slice} and {frame}, which each
/// engine has names of its own for; everything else is as it was typed.
struct FarmWord {
  std::string text;
  bool is_template = false;
};

/// A command that is run `slices` times, with {slice} from 1 on, and as often for each of the frames, on any machines, in any
/// order, and again if need be.
struct FarmStep {
  std::string name;  ///< one word
  std::vector<FarmWord> command;
  int slices = 1;
  int threads = 1;
  std::size_t memory = 0;     ///< bytes
  std::vector<int> frames{};  ///< none: there is but one picture, and no {frame}

  /// Those of a frame follow each other.
  int tasks() const { return slices * std::max(static_cast<int>(frames.size()), 1); }
};

/// Steps, each of which waits for the end of the one before: what a render is to learn before its slices is one more, in front.
struct FarmJob {
  std::string name;
  std::string program, scene, folder, output;  ///< absolute paths, the same on all machines
  std::vector<FarmStep> steps;
  std::vector<std::string> engine_options;  ///< in the engine's own words
};

/// A file of a job, in its folder.
struct FarmFile {
  std::string name, text;
};

/// A job as an engine takes it, and how it is told to.
struct FarmFiles {
  std::vector<FarmFile> files;
  std::string start;  ///< the command that starts it
};

/// An array of jobs for Slurm, and a dependent one, as scripts with #SBATCH lines; submit.sh submits them.
FarmFiles slurm_files(const FarmJob& job);
/// For GNU parallel: run.sh.
FarmFiles parallel_files(const FarmJob& job);
/// A template of Open Job Description 2023-09, which Deadline Cloud and others take, and the values of its parameters.
/// Throws Error (usage) for text that its format strings cannot hold.
FarmFiles openjd_files(const FarmJob& job);

}  // namespace tyndall
