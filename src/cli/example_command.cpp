#include <fmt/core.h>

#include "cli/command.h"
#include "cli/log.h"
#include "cli/print.h"
#include "cli/validators.h"
#include "example/example.h"
#include "tyndall/error.h"

namespace tyndall::cli {
namespace {

struct Arguments {
  std::string name, folder, shape, resolution;
  bool list = false;
  ExampleOptions options;
};

/// Name, default options, title: a line each.
std::string list_text() {
  std::string text;
  for (const ExampleInfo& e : example_list()) {
    std::string options = e.lights ? fmt::format("--lights {} ", *e.lights) : "";
    if (e.density) options += fmt::format("--density {} ", *e.density);
    if (e.shape) options += *e.shape == LampShape::point ? "--shape point " : "--shape triangle ";
    text += fmt::format("{:15} {:60} {}\n", e.name, e.title, options + fmt::format("--max-depth {}", e.max_depth));
  }
  return text;
}

void read_resolution(const std::string& text, ExampleOptions& options) {
  int used = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%n", &options.width, &options.height, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size())
    throw Error(Failure::usage, "--resolution " + text + " is not understood; give WxH in pixels, such as 640x360");
}

int run_example(Arguments& a) {
  if (a.list) {
    print("{}", list_text());
    return 0;
  }
  if (!a.shape.empty()) a.options.shape = a.shape == "point" ? LampShape::point : LampShape::triangle;
  if (!a.resolution.empty()) read_resolution(a.resolution, a.options);
  const std::vector<ExampleFile> files = make_example(a.name, a.options);
  print("{}\n", write_example(files, a.folder.empty() ? a.name : a.folder));
  return 0;
}

}  // namespace

void add_example(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("example", "write a ready scene, the same bytes for the same parameters");
  auto a = std::make_shared<Arguments>();
  command->add_option("name", a->name, "which one; see --list");
  command->add_flag("--list", a->list, "name, title and defaults of every example");
  command->add_option(
      "-o,--output", a->folder,
      "folder to write into, made when missing; only the example's own files are overwritten [NAME]; -o scenes");
  command->add_option("--lights", a->options.lights,
                      "how many small lights share the scene's power, 1 to 10000000; mesh-light-fog: triangles, to about "
                      "one ring of the mesh [see --list]; --lights 1000000");
  command->add_option("--density", a->options.density, "factor on the medium's density, 0 to 1000 [1]; --density 2.5");
  command
      ->add_option("--shape", a->shape,
                   "of smoke-lights' lights, triangle (in a few binary PLY files) or point (a line of text each) [triangle]; "
                   "--shape point")
      ->check(CLI::IsMember({"triangle", "point"}));
  command->add_option("--max-depth", a->options.max_depth, "bounces a path, at most [see --list]; --max-depth 8");
  command->add_option("--resolution", a->resolution, "frame size in pixels [640x360]; --resolution 1280x720");
  command->add_option("--seed", a->options.seed, "of everything random in the scene [0]; --seed 7")->check(whole_number());
  command->footer("Examples and their defaults:\n" + list_text());
  command->callback([a, &exit_code] {
    if (!a->list && a->name.empty()) throw Error(Failure::usage, "example takes a name or --list:\n" + list_text());
    exit_code = run_example(*a);
  });
}

}  // namespace tyndall::cli
