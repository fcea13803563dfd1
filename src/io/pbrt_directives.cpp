#include "io/pbrt_directives.h"

#include <unordered_map>

#include "io/pbrt_blocks.h"
#include "io/pbrt_lights.h"
#include "io/pbrt_materials.h"
#include "io/pbrt_media.h"
#include "io/pbrt_settings.h"
#include "io/pbrt_shapes.h"
#include "io/pbrt_textures.h"
#include "io/pbrt_transforms.h"
#include "io/pbrt_view.h"

namespace tyndall::pbrt {
namespace {

using Scope = Directive::Scope;

/// How to build the scene's acceleration structure is Tyndall's own business.
void read_accelerator(State& state, Tokenizer& in, const Location&) {
  in.expect_string("a kind of accelerator");
  read_params(in, state.graphics.color_space);
}

constexpr Directive kDirectives[] = {
    {"Accelerator", Scope::options, read_accelerator},
    {"ActiveTransform", Scope::anywhere, read_active_transform},
    {"AreaLightSource", Scope::world, read_area_light_source},
    {"Attribute", Scope::anywhere, read_attribute},
    {"AttributeBegin", Scope::world, read_attribute_begin},
    {"AttributeEnd", Scope::world, read_attribute_end},
    {"Camera", Scope::options, read_camera},
    {"ColorSpace", Scope::anywhere, read_color_space},
    {"ConcatTransform", Scope::anywhere, read_concat_transform},
    {"CoordSysTransform", Scope::anywhere, read_coord_sys_transform},
    {"CoordinateSystem", Scope::anywhere, read_coordinate_system},
    {"Film", Scope::options, read_film},
    {"Identity", Scope::anywhere, read_identity},
    {"Import", Scope::world, nullptr},
    {"Include", Scope::anywhere, nullptr},
    {"Integrator", Scope::options, read_integrator},
    {"LightSource", Scope::world, read_light_source},
    {"LookAt", Scope::anywhere, read_look_at},
    {"MakeNamedMaterial", Scope::world, read_make_named_material},
    {"MakeNamedMedium", Scope::anywhere, read_make_named_medium},
    {"Material", Scope::world, read_material},
    {"MediumInterface", Scope::anywhere, read_medium_interface},
    {"NamedMaterial", Scope::world, read_named_material},
    {"ObjectBegin", Scope::world, read_object_begin},
    {"ObjectEnd", Scope::world, read_object_end},
    {"ObjectInstance", Scope::world, read_object_instance},
    {"Option", Scope::anywhere, read_option},
    {"PixelFilter", Scope::options, read_pixel_filter},
    {"ReverseOrientation", Scope::world, read_reverse_orientation},
    {"Rotate", Scope::anywhere, read_rotate},
    {"Sampler", Scope::options, read_sampler},
    {"Scale", Scope::anywhere, read_scale},
    {"Shape", Scope::world, read_shape},
    {"Texture", Scope::world, read_texture},
    {"Transform", Scope::anywhere, read_transform},
    {"TransformBegin", Scope::world, read_transform_begin},
    {"TransformEnd", Scope::world, read_transform_end},
    {"TransformTimes", Scope::options, read_transform_times},
    {"Translate", Scope::anywhere, read_translate},
    {"WorldBegin", Scope::options, read_world_begin},
};

}  // namespace

const Directive* find_directive(std::string_view name) {
  static const auto table = [] {
    std::unordered_map<std::string_view, const Directive*> t;
    for (const Directive& d : kDirectives) t[d.name] = &d;
    return t;
  }();
  const auto it = table.find(name);
  return it == table.end() ? nullptr : it->second;
}

std::vector<std::string> directive_names() {
  std::vector<std::string> names;
  for (const Directive& d : kDirectives) names.emplace_back(d.name);
  return names;
}

void check_scope(const Directive& directive, State& state, const Location& where) {
  if (directive.scope == Scope::options && state.in_world && !state.world_assumed)
    throw Error(where, std::string(directive.name) + " stands after WorldBegin; move it before WorldBegin");
  if (directive.scope == Scope::world && !state.in_world) {
    state.in_world = state.world_assumed = true;
    throw Error(where, std::string(directive.name) + " stands before WorldBegin; move it after WorldBegin, or add that line");
  }
}

}  // namespace tyndall::pbrt
