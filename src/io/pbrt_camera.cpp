#include <algorithm>
#include <string>
#include <utility>

#include "io/lens_file.h"
#include "io/pbrt_suggest.h"
#include "io/pbrt_view.h"

namespace tyndall::pbrt {
namespace {

/// Seconds the shutter is open; it only scales the picture, since nothing moves.
double read_exposure(ParamList& params) {
  const double open = params.number("shutteropen", 0), close = params.number("shutterclose", 1);
  if (!(close > open)) throw params.error("shutterclose", "the shutter does not open; shutterclose must be above shutteropen");
  return close - open;
}

void read_lens(ParamList& params, Camera& camera) {
  camera.lens_radius = params.number("lensradius", 0);
  camera.focal_distance = params.number("focaldistance", 1e6f);
  if (camera.lens_radius < 0) throw params.error("lensradius", "lensradius must not be negative");
  if (!(camera.focal_distance > 0)) throw params.error("focaldistance", "focaldistance must be above 0");
}

void read_screen(ParamList& params, Camera& camera) {
  camera.frame_aspect_ratio = params.maybe_number("frameaspectratio");
  if (camera.frame_aspect_ratio && !(*camera.frame_aspect_ratio > 0))
    throw params.error("frameaspectratio", "frameaspectratio must be above 0");
  const std::vector<float> window = params.numbers("screenwindow");
  if (window.empty()) return;
  if (window.size() != 4) throw params.error("screenwindow", "screenwindow takes four numbers: x0 x1 y0 y1");
  if (window[0] == window[1] || window[2] == window[3])
    throw params.error("screenwindow", "screenwindow is empty; x0 and x1, y0 and y1 must differ");
  camera.screen_window = {window[0], window[1], window[2], window[3]};
}

/// pbrt takes the parameters of lens and screen here too, and passes them over.
Camera::Kind read_mapping(ParamList& params) {
  Camera unused;
  read_lens(params, unused);
  read_screen(params, unused);
  return params.choice("mapping", "equalarea", {"equalarea", "equirectangular"}) == "equalarea"
             ? Camera::Kind::spherical_equal_area
             : Camera::Kind::spherical_equirectangular;
}

void set_aperture(ParamList& params, std::vector<LensElement>& elements) {
  const float diameter = params.number("aperturediameter", 1);
  if (!(diameter >= 1e-3f)) throw params.error("aperturediameter", "aperturediameter must be at least 0.001 mm");
  const auto stop = std::find_if(elements.begin(), elements.end(), [](const LensElement& e) { return e.radius == 0; });
  if (stop == elements.end()) {
    if (params.find("aperturediameter", {ParamType::number}))
      params.reports().warn(params.where("aperturediameter"),
                            "aperturediameter is ignored: the lens file has no stop (radius 0)");
  } else if (diameter / 2000 > stop->aperture_radius) {
    params.reports().warn(params.where("aperturediameter"),
                          "aperturediameter is wider than the stop of the lens file; the stop's own is taken");
  } else {
    stop->aperture_radius = diameter / 2000;
  }
}

Lenses read_lenses(State& state, ParamList& params, const Location& where) {
  Lenses lenses;
  lenses.where = where;
  const std::string file = params.string("lensfile", "");
  if (file.empty()) throw params.error("camera \"realistic\" needs \"string lensfile\"; name a file of lenses");
  lenses.elements = read_lens_file(resolve_asset(state, params.where("lensfile"), file));
  set_aperture(params, lenses.elements);
  lenses.focus_distance = params.number("focusdistance", 10);
  if (!(lenses.focus_distance > 0)) throw params.error("focusdistance", "focusdistance must be above 0");
  const std::string stop = params.string("aperture", "");
  const std::vector<std::string> names{"gaussian", "square", "pentagon", "star"};
  if (const auto at = std::find(names.begin(), names.end(), stop); at != names.end())
    lenses.stop = static_cast<Lenses::Stop>(1 + (at - names.begin()));
  else if (!stop.empty())
    throw params.error("aperture",
                       "images of an aperture are not supported by Tyndall; use \"gaussian\", \"square\", "
                       "\"pentagon\" or \"star\", or none for a circle");
  return lenses;
}

}  // namespace

void read_camera(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of camera, as \"perspective\"").text);
  ParamList params = read_param_list(state, in, "camera \"" + printable(type) + "\"", where);
  Camera camera;
  camera.to_world = usable_ctm(state, where).inverse();
  camera.medium = state.graphics.outside;
  if (type == "orthographic")
    camera.kind = Camera::Kind::orthographic;
  else if (type != "perspective" && type != "spherical" && type != "realistic")
    throw params.error("camera \"" + printable(type) + "\" is unknown; " +
                       suggestion(type, {"perspective", "orthographic", "spherical", "realistic"}));
  const double exposure = read_exposure(params);
  if (type == "spherical") {
    camera.kind = read_mapping(params);
  } else if (type == "realistic") {
    camera.kind = Camera::Kind::realistic;
    camera.lenses = read_lenses(state, params, where);
  } else {
    read_lens(params, camera);
    read_screen(params, camera);
  }
  if (camera.kind == Camera::Kind::perspective) {
    camera.fov_degrees = params.number("fov", 90);
    if (!(camera.fov_degrees > 0 && camera.fov_degrees < 180))
      throw params.error("fov", "fov must lie between 0 and 180 degrees");
  }
  params.finish();
  state.coordinate_systems["camera"] = {camera.to_world, {}};
  state.exposure_time = exposure;
  state.scene.camera = std::move(camera);
}

}  // namespace tyndall::pbrt
