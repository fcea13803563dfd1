#include "io/pbrt_settings.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>

#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

int at_least(ParamList& params, std::string_view name, int otherwise, int least) {
  const int value = params.integer(name, otherwise);
  if (value < least) throw params.error(name, std::string(name) + " must be at least " + std::to_string(least));
  return value;
}

int count_up_to(ParamList& params, std::string_view name, int most) {
  const int count = at_least(params, name, 0, 0);
  if (count > most) throw params.error(name, std::string(name) + " must be at most " + std::to_string(most));
  return count;
}

/// Of paths without end a render could neither be stopped nor keep its time.
int read_max_depth(ParamList& params, std::string_view name, int otherwise) {
  const int depth = at_least(params, name, otherwise, 0);
  if (depth <= kMostBounces) return depth;
  params.reports().warn(params.where(name),
                        std::string(name) + " is more than " + std::to_string(kMostBounces) + ", and taken for that");
  return kMostBounces;
}

void read_strategy(ParamList& params, const StrategyAxis& axis, RenderSettings& settings) {
  if (!params.find(axis.option, {ParamType::string})) return;
  const std::string text = params.string(axis.option, "");
  if (axis.set(settings, text)) return;
  throw params.error(axis.option, "\"" + printable(text) + "\" is no value of \"" + std::string(axis.option) + "\"; " +
                                      suggestion(text, {axis.names.begin(), axis.names.end()}));
}

/// Samples a pixel as pbrt's sampler of this type takes them.
int read_pixel_samples(ParamList& params, const std::string& type) {
  if (type == "stratified") {
    const int x = at_least(params, "xsamples", 4, 1), y = at_least(params, "ysamples", 4, 1);
    if (double(x) * y > 1e9) throw params.error("xsamples", "xsamples * ysamples is too large");
    params.boolean("jitter", true);
    return x * y;
  }
  params.string("randomization", "");  // ours is always Owen scrambled
  return at_least(params, "pixelsamples", type == "independent" ? 4 : 16, 1);
}

/// pbrt's own light samplers.
void read_light_sampler(ParamList& params, RenderSettings& settings) {
  const std::string sampler = params.choice("lightsampler", "", {"", "uniform", "power", "bvh", "exhaustive"});
  if (sampler == "bvh") settings.lights = LightStrategy::tree;
  if (sampler == "uniform") settings.lights = LightStrategy::uniform;
  if (sampler == "power") settings.lights = LightStrategy::power;
  if (sampler == "exhaustive") settings.lights = LightStrategy::exhaustive;
}

/// `name` outlives the list, which keeps it.
std::optional<double> maybe_relmse(ParamList& params, std::string_view name) {
  const auto error = params.maybe_number(name);
  if (error && !(*error > 0)) throw params.error(name, std::string(name) + " must be above 0; it is a relMSE, as 0.001");
  return error;
}

/// Tyndall's options under the names of the command line.
void read_own_options(State& state, ParamList& params) {
  RenderSettings& s = state.scene.settings;
  state.spp_from_integrator |= params.find("spp", {ParamType::integer}) != nullptr;
  state.seed_from_integrator |= params.find("seed", {ParamType::integer}) != nullptr;
  s.spp = at_least(params, "spp", s.spp, 1);
  if (state.seed_from_integrator) s.seed = static_cast<std::uint64_t>(params.integer("seed", 0));
  if (const auto time = params.maybe_number("time")) {
    if (!(*time > 0)) throw params.error("time", "time must be above 0 seconds");
    s.time = *time;
  }
  if (params.find("threads", {ParamType::integer})) s.threads = count_up_to(params, "threads", kMostThreads);
  if (const auto error = maybe_relmse(params, "error")) s.error = error;
  if (const auto error = maybe_relmse(params, "error-max")) s.error_max = error;
  if (params.find("adaptive", {ParamType::boolean})) s.adaptive = params.boolean("adaptive", false);
  if (params.find("candidates", {ParamType::integer})) s.candidates = count_up_to(params, "candidates", kMostLights);
  if (const auto splitting = params.maybe_number("splitting")) {
    if (!(*splitting >= 0 && *splitting <= 1)) throw params.error("splitting", "splitting must be from 0 to 1");
    s.splitting = static_cast<float>(*splitting);
  }
  if (params.find("shadow-rays", {ParamType::integer})) s.shadow_rays = count_up_to(params, "shadow-rays", kMostLights);
  for (const StrategyAxis& axis : strategy_axes()) read_strategy(params, axis, s);  // "lights" wins over "lightsampler"
  s.reproducible = params.boolean("reproducible", s.reproducible);
  if (params.find("aov", {ParamType::string})) s.aovs = params.strings("aov");
  const std::vector<std::string_view> known = aov_names();
  for (const std::string& aov : s.aovs)
    if (std::find(known.begin(), known.end(), aov) == known.end())
      throw params.error("aov", "\"" + printable(aov) + "\" is no AOV; " + suggestion(aov, {known.begin(), known.end()}));
  if (const auto crop = params.integers("crop"); !crop.empty()) {
    if (crop.size() != 4) throw params.error("crop", "crop takes four integers: x0 x1 y0 y1");
    s.crop = PixelBounds{crop[0], crop[2], crop[1], crop[3]};
    state.crop_where = params.where("crop");
  }
}

void ask_for_foreign_parameters(ParamList& params, const std::string& type) {
  if (type == "ao") params.boolean("cossample", true), params.number("maxdistance", kInfinity);
  if (type == "simplepath") params.boolean("samplelights", true), params.boolean("samplebsdf", true);
  if (type == "bdpt") params.boolean("visualizestrategies", false), params.boolean("visualizeweights", false);
  if (type == "mlt")
    for (const char* name : {"bootstrapsamples", "chains", "mutationsperpixel"}) params.integer(name, 0);
  if (type == "mlt") params.number("largestepprobability", 0.3f), params.number("sigma", 0.01f);
  if (type == "sppm") params.integer("photonsperiteration", -1), params.number("radius", 1);
}

void cut_crop_to_frame(State& state) {
  const Film& film = state.scene.film;
  PixelBounds& crop = *state.scene.settings.crop;
  const PixelBounds cut{std::max(crop.x0, 0), std::max(crop.y0, 0), std::min(crop.x1, film.width),
                        std::min(crop.y1, film.height)};
  if (cut.width() < 1 || cut.height() < 1) throw Error(*state.crop_where, "crop leaves no pixel of the frame; widen it");
  if (cut != crop) state.reports.warn(*state.crop_where, "crop reaches beyond the picture; it is cut to it");
  crop = cut;
}

}  // namespace

void finish_settings(State& state) {
  RenderSettings& s = state.scene.settings;
  if (s.crop && state.crop_where) cut_crop_to_frame(state);
  if (!state.spp_from_sampler && !state.spp_from_integrator && (s.time || s.error || s.error_max))
    s.spp = std::numeric_limits<int>::max();
}

void warn_of_media_passed_over(State& state) {
  if (state.surface_integrator && !state.scene.media.empty())
    state.reports.warn(
        *state.surface_integrator,
        "integrator \"path\" is replaced by \"volpath\": the media of the scene are rendered, in pbrt-v4 they are "
        "passed over");
}

void read_sampler(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of sampler, as \"independent\"").text);
  ParamList params = read_param_list(state, in, "sampler \"" + printable(type) + "\"", where);
  const std::vector<std::string> known{"halton", "independent", "paddedsobol", "pmj02bn", "sobol", "stratified", "zsobol"};
  if (std::find(known.begin(), known.end(), type) == known.end())
    throw params.error("sampler \"" + printable(type) + "\" is unknown; " + suggestion(type, known));
  for (const char* name : {"pixelsamples", "xsamples", "ysamples"}) {
    state.spp_from_sampler |= params.find(name, {ParamType::integer}) != nullptr;
  }
  const int samples = read_pixel_samples(params, type);
  const auto seed = static_cast<std::uint64_t>(params.integer("seed", 0));
  params.finish();
  if (!state.spp_from_integrator) state.scene.settings.spp = samples;
  if (!state.seed_from_integrator) state.scene.settings.seed = seed;
}

void read_integrator(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of integrator, as \"volpath\"").text);
  ParamList params = read_param_list(state, in, "integrator \"" + printable(type) + "\"", where);
  const std::vector<std::string> known{"volpath",    "path", "simplevolpath", "simplepath", "lightpath",
                                       "randomwalk", "bdpt", "mlt",           "sppm",       "ao"};
  if (std::find(known.begin(), known.end(), type) == known.end())
    throw params.error("integrator \"" + printable(type) + "\" is unknown; " + suggestion(type, known));
  if (type == "path") state.surface_integrator = where;
  if (type != "volpath" && type != "path")
    params.reports().warn(where, "integrator \"" + type + "\" is replaced by \"volpath\", the one method of Tyndall");
  RenderSettings& settings = state.scene.settings;
  settings.max_depth = read_max_depth(params, "maxdepth", 5);
  settings.max_depth = read_max_depth(params, "max-depth", settings.max_depth);
  read_light_sampler(params, settings);
  if (params.boolean("regularize", false))
    params.reports().warn(params.where("regularize"), "parameter \"regularize\" is ignored: it would bias the picture");
  ask_for_foreign_parameters(params, type);
  read_own_options(state, params);
  params.finish();
}

void read_option(State& state, Tokenizer& in, const Location& where) {
  const Token declaration = in.expect_string("an option name");
  const Token value = in.next();
  if (value.is(Token::Kind::end)) throw in.error(value.at, "option has no value; give one");
  // pbrt compares names without case, '-' and '_'; a type before the name is allowed.
  std::string name;
  for (const char c : declaration.text.substr(declaration.text.find_last_of(' ') + 1))
    if (c != '-' && c != '_') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (name == "seed") {
    state.scene.settings.seed = static_cast<std::uint64_t>(in.to_integer(value));
    return;
  }
  const std::vector<std::string> known{"disablepixeljitter",
                                       "disabletexturefiltering",
                                       "disablewavelengthjitter",
                                       "displacementedgescale",
                                       "forcediffuse",
                                       "msereferenceimage",
                                       "msereferenceout",
                                       "pixelstats",
                                       "rendercoordsys",
                                       "seed",
                                       "wavefront"};
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw in.error(declaration.at, "option \"" + printable(declaration.text) + "\" is unknown; " + suggestion(name, known));
  if (value.text == "false") return;
  if (name == "rendercoordsys") state.render_in_world_space = value.text == "world";
  if (name == "disablepixeljitter")
    state.reports.warn(where,
                       "option \"disablepixeljitter\" is ignored: samples spread over the pixel, so that edges are smooth");
  if (name == "forcediffuse" || name.starts_with("mse") || name == "pixelstats" || name == "displacementedgescale")
    state.reports.warn(where, "option \"" + name + "\" is ignored");
}

}  // namespace tyndall::pbrt
