#include "cli/method_options.h"

#include "cli/option_values.h"
#include "cli/validators.h"

namespace tyndall::cli {

void declare(CLI::App& command, MethodOptions& o) {
  for (std::size_t i = 0; i < strategy_axes().size(); ++i) {
    const StrategyAxis& axis = strategy_axes()[i];
    const std::string option = "--" + std::string(axis.option);
    command.add_option(option, o.strategies[i],
                       std::string(axis.about) + ": " + join(axis.names, ", ") + " [the Integrator's, else " +
                           std::string(axis.get({})) + "]; " + option + " " + std::string(axis.names.back()));
  }
  command
      .add_option("--candidates", o.candidates,
                  "lights chosen at a vertex or along a segment and looked at without visibility; 0: one for each "
                  "cluster that --splitting makes; with --lights lightcuts the most nodes that a cut has, 0: 1,000 [the "
                  "Integrator's, else as --budget has it at first, later 1 to 4, but not more than there are lights unless "
                  "--max-depth is 1; with lightcuts 0]; --candidates 8")
      ->check(CLI::Range(0, kMostLights));
  command
      .add_option("--splitting", o.splitting,
                  "clusters of the light tree predicted worse than this are split, with --lights tree, up to 15 or as many as "
                  "--candidates, 0..1; 0: none, 1: down to single lights [the Integrator's, else 0.5 for --candidates 0; "
                  "elsewhere, at points, what may hold a light that is so near that it deserves a candidate is split]; "
                  "--splitting 0.7")
      ->check(fraction());
  command
      .add_option("--shadow-rays", o.shadow_rays,
                  "of these are traced, resampled by their contribution; 0: all [the Integrator's, else as --budget has it at "
                  "first, later 1 or 2, but not more than half the lights unless --max-depth is 1; with lightcuts "
                  "all]; --shadow-rays 0")
      ->check(CLI::Range(0, kMostLights));
}

void apply(const MethodOptions& o, RenderSettings& settings) {
  for (std::size_t i = 0; i < strategy_axes().size(); ++i) {
    const StrategyAxis& axis = strategy_axes()[i];
    const std::string& name = o.strategies[i];
    if (!name.empty() && !axis.set(settings, name)) refuse_value("--" + std::string(axis.option), name, join(axis.names, ", "));
  }
  if (o.candidates) settings.candidates = *o.candidates;
  if (o.splitting) settings.splitting = static_cast<float>(*o.splitting);
  if (o.shadow_rays) settings.shadow_rays = *o.shadow_rays;
}

}  // namespace tyndall::cli
