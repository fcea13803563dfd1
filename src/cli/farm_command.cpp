#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <regex>
#include <thread>

#include "cli/command.h"
#include "cli/farm_trial.h"
#include "cli/frame_list.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/render_options.h"
#include "cli/validators.h"
#include "farm/farm_job.h"
#include "report/shell_quote.h"
#include "session/memory_plan.h"
#include "tyndall/frames.h"
#include "tyndall/io.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

namespace fs = std::filesystem;

struct FarmOptions {
  std::string engine, folder, program;
  int slices = 0;
  double checkpoint = 60;
  std::optional<double> error, memory;
  std::vector<std::string> engine_options;
  bool no_trial = false, print = false, submit = false;
  RenderOptions render;
};

/// What is the farm's own; everything else is passed on to render.
constexpr const char* kOwn[] = {"engine",       "scene",      "--output",  "--slices",        "--folder",   "--program",
                                "--checkpoint", "--error",    "--memory",  "--engine-option", "--no-trial", "--print",
                                "--submit",     "--progress", "--threads", "--frames",        "--help"};

bool is_own(const std::string& name) {
  return std::any_of(std::begin(kOwn), std::end(kOwn), [&](const char* own) { return name == own; });
}

std::vector<FarmWord> passed_on(const CLI::App& command) {
  std::vector<FarmWord> words;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || is_own(option->get_name())) continue;
    words.push_back({option->get_name()});
    if (option->get_items_expected_max() == 0) continue;
    for (const std::string& value : option->results()) words.push_back({value});
  }
  return words;
}

std::string absolute(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

std::string this_program() {
  std::error_code unknown;
  const fs::path path = fs::read_symlink("/proc/self/exe", unknown);
  return unknown ? "tyndall" : path.string();
}

int threads_of(const FarmOptions& options) {
  const int given = options.render.threads.value_or(0);
  return given > 0 ? given : static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

std::vector<int> frames_of(const FarmOptions& options) {
  return options.render.frames.empty() ? std::vector<int>() : frames_in(options.render.frames);
}

FarmStep render_step(const FarmOptions& options, const CLI::App& command) {
  std::vector<FarmWord> words = {{"{program}", true}, {"render"}, {"{scene}", true}};
  const std::vector<FarmWord> given = passed_on(command);
  words.insert(words.end(), given.begin(), given.end());
  // Where GNU parallel sends a task, it has the machine for itself.
  if (options.engine != "parallel" || options.render.threads)
    words.insert(words.end(), {{"--threads"}, {std::to_string(threads_of(options))}});
  const bool sequence = !options.render.frames.empty();
  if (sequence) words.insert(words.end(), {{"--frames"}, {"{frame}", true}});
  words.insert(words.end(), {{"--slice"},
                             {fmt::format("{{slice}}/{}", options.slices), true},
                             {"--resume"},
                             {"--checkpoint"},
                             {fmt::format("{}", options.checkpoint)},
                             {"--progress"},
                             {"line"},
                             {"-o"},
                             {sequence ? "{folder}/slices/%d/slice-{slice}.exr" : "{folder}/slices/slice-{slice}.exr", true}});
  return {"render", words, options.slices, threads_of(options), 0, frames_of(options)};
}

FarmStep merge_step(const FarmOptions& options) {
  std::vector<FarmWord> words = {{"{program}", true}, {"merge"}};
  const bool sequence = !options.render.frames.empty();
  words.push_back({sequence ? "{folder}/slices/%d" : "{folder}/slices", true});
  if (sequence) words.insert(words.end(), {{"--frames"}, {"{frame}", true}});
  words.insert(words.end(), {{"-o"}, {"{output}", true}});
  if (options.error) words.insert(words.end(), {{"--error"}, {fmt::format("{}", *options.error)}});
  return {"merge", words, 1, 1, 0, frames_of(options)};
}

/// Every slice must have samples: the smallest tells.
void require_slices(const FarmOptions& options, RenderSettings settings) {
  if (options.slices == 1 && options.render.frames.empty())
    throw Error(Failure::usage, "--slices 1 is one picture on one machine, which is no job; give 2 or more, or --frames");
  for (int i = 1; i <= options.slices; ++i) {
    settings.slice = SliceChoice{i, options.slices};
    sample_range(settings);
  }
  const std::size_t frames = std::max<std::size_t>(frames_of(options).size(), 1);
  if (options.engine == "slurm" && static_cast<std::size_t>(options.slices) * frames > 1000)
    log("note: Slurm takes array numbers below its MaxArraySize, which is 1001 unless your administrator has raised it\n");
}

void write_job(const FarmFiles& job, const std::string& folder, const std::vector<int>& job_frames) {
  make_folder(folder);
  make_folder(folder + "/slices");
  for (const int frame : job_frames) make_folder(fmt::format("{}/slices/{}", folder, frame));
  make_folder(folder + "/logs");
  for (const FarmFile& file : job.files) write_file(file.text, folder + "/" + file.name);
}

/// The engine's own program takes this one's place: its output and exit code are what is seen.
[[noreturn]] void start(const std::string& command) {
  finish_printing();
  execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
  throw Error(Failure::run_time, "sh cannot be run: " + std::string(std::strerror(errno)) + "; run it yourself: " + command);
}

FarmFiles files_of(const FarmJob& job, const std::string& engine) {
  if (engine == "slurm") return slurm_files(job);
  return engine == "openjd" ? openjd_files(job) : parallel_files(job);
}

std::string output_of(const FarmOptions& options, const Scene& scene) {
  const std::string output = absolute(output_path(options.render, scene));
  if (!options.render.frames.empty()) require_frame_place(output, "-o");
  if (fs::path(output).extension() == ".exr") return output;
  throw Error(Failure::usage, "output " + output + ": slices are merged to .exr; give a name that ends so");
}

/// For the merge: the sums, a slice as it is read, and the image, about as the plan of a slice has them.
void set_memory(const FarmOptions& options, std::size_t planned, std::size_t tried, FarmJob& job) {
  constexpr double kHeadroom = 1.25, kLibraries = 256e6;
  const auto needed = static_cast<std::size_t>(kLibraries + kHeadroom * static_cast<double>(std::max(planned, tried)));
  for (FarmStep& step : job.steps) step.memory = options.memory ? static_cast<std::size_t>(*options.memory * 1e9) : needed;
}

FarmJob job_of(const FarmOptions& options, const CLI::App& command, const std::string& output) {
  FarmJob job;
  // Without the place for a frame's number: folders of tasks have one of their own.
  static const std::regex kPlace("[._-]?(%[0-9]*d|\\$F[0-9]?)");
  const std::string name = std::regex_replace(fs::path(output).stem().string(), kPlace, "");
  job.name = std::regex_replace(name, std::regex("[^A-Za-z0-9._-]"), "_");
  job.program = options.program.empty() ? this_program() : options.program;
  job.scene = absolute(options.render.scene);
  job.folder = absolute(options.folder.empty() ? (fs::path(output).parent_path() / (name + "-farm")).string() : options.folder);
  if (!options.render.frames.empty() && names_frame(job.folder))
    throw Error(Failure::usage, "folder " + job.folder + " has a place for a frame's number; choose another with --folder");
  job.output = output;
  job.steps = {render_step(options, command), merge_step(options)};
  job.engine_options = options.engine_options;
  return job;
}

/// The scene, of the first frame; all files of all frames are there.
SceneFile read_first(const FarmOptions& options) {
  const std::vector<int> frames = frames_of(options);
  if (frames.empty()) return read_scene(options.render.scene);
  SceneFile file = read_scene(options.render.scene, {.frame = frames.front()});
  for (const int frame : frames) require_frame(file, options.render.scene, frame);
  return file;
}

std::string frames_prefix(const FarmStep& step) {
  return step.frames.empty() ? "" : fmt::format("{} frames of ", step.frames.size());
}

int run_farm(const FarmOptions& options, const CLI::App& command) {
  if (options.submit && options.print) throw Error(Failure::usage, "--print writes nothing that could be submitted; give one");
  if (options.submit && options.engine == "openjd")
    throw Error(Failure::usage, "openjd has no command that submits: leave --submit out, and give the folder to your farm");
  Timer timer;
  SceneFile file = read_first(options);
  apply(options.render, file.scene);
  const RenderSettings settings = file.scene.settings;
  require_slices(options, settings);
  FarmJob job = job_of(options, command, output_of(options, file.scene));
  files_of(job, options.engine);  // throws for what the engine cannot hold, before anything takes time
  file.scene.settings.slice = SliceChoice{1, options.slices};
  const LightStrategy lights[] = {settings.lights};
  const std::size_t planned = plan_memory(file.scene, lights).total();
  file.scene.settings.slice.reset();
  std::optional<FarmTrial> trial;
  if (!options.no_trial)
    trial = try_out(std::move(file.scene), options.render.picture.sanitize, timer.lap(), options.render.progress);
  set_memory(options, planned, trial ? trial->memory : 0, job);

  const FarmFiles files = files_of(job, options.engine);
  if (options.print) {
    for (const FarmFile& f : files.files) print("==> {} <==\n{}\n", f.name, f.text);
  } else {
    write_job(files, job.folder, job.steps.front().frames);
    print("{}: {}{} slices, {:.1f} GB and {} threads each\n", job.folder, frames_prefix(job.steps.front()), options.slices,
          static_cast<double>(job.steps.front().memory) * 1e-9, threads_of(options));
  }
  if (trial) log_text(as_text(*trial, settings, options.slices));
  if (options.submit) start(files.start);
  if (!options.print)
    print("start it:  {}\nlook:      tyndall status {}\n", files.start,
          shell_quoted(job.folder + "/slices" + (job.steps.front().frames.empty() ? "" : "/FRAME")));
  return 0;
}

void declare(CLI::App& command, FarmOptions& o) {
  command.add_option("engine", o.engine, "slurm, openjd (Open Job Description 2023-09: Deadline Cloud and others) or parallel")
      ->required()
      ->check(CLI::IsMember({"slurm", "openjd", "parallel"}));
  declare_task(command, o.render);
  command
      .add_flag_function("--adaptive",
                         [](std::int64_t) {
                           throw Error(Failure::usage,
                                       "a farm's slices cannot be adaptive: where the error is only all of them together tell; "
                                       "leave --adaptive out, or render without slices");
                         })
      ->group("");  // not listed: it is told to those who look for it
  command.add_option("--slices", o.slices, "how many, of each frame; each begins at a multiple of 16 samples; --slices 64")
      ->required()
      ->check(CLI::Range(1, kMostSlices));
  command
      .add_option("--error", o.error, "relMSE that is wanted: merge says how many samples more it takes [none]; --error 0.001")
      ->check(positive());
  command.add_option("--folder", o.folder,
                     "where scripts, slices, checkpoints and logs go, shared by all machines [OUTPUT-farm]; --folder /net/job");
  command.add_option("--program", o.program, "tyndall as the machines find it [this program]; --program /net/bin/tyndall");
  command
      .add_option("--checkpoint", o.checkpoint,
                  "seconds between the saves that a stopped slice goes on from [60]; --checkpoint 300")
      ->check(positive());
  command.add_option("--memory", o.memory, "GB a task [estimated, and from a trial]; --memory 16")->check(positive());
  command
      .add_option("--engine-option", o.engine_options,
                  "one of the engine's own, as often as needed: a line #SBATCH, or for parallel [none]; --engine-option "
                  "--partition=night")
      ->expected(1)
      ->take_all();
  command.add_flag("--no-trial", o.no_trial, "do not render a few samples here to tell how long the slices take");
  auto* print = command.add_flag("--print", o.print, "show what would be written, and write nothing");
  command.add_flag("--submit", o.submit, "and start it; parallel runs to its end")->excludes(print);
}

}  // namespace

void add_farm(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("farm", "write the job that renders a scene in slices on many machines, and merges them");
  auto options = std::make_shared<FarmOptions>();
  declare(*command, *options);
  command->footer("Example: tyndall farm slurm hall.pbrt --spp 4096 --slices 64 -o hall.exr");
  command->callback([options, command, &exit_code] { exit_code = run_farm(*options, *command); });
}

}  // namespace tyndall::cli
