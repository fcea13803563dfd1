#include "io/pbrt_blocks.h"

#include <string>
#include <utility>

#include "io/pbrt_settings.h"
#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

const char* begin_of(Block::Kind kind) { return kind == Block::Kind::object ? "ObjectBegin" : "AttributeBegin"; }
const char* end_of(Block::Kind kind) { return kind == Block::Kind::object ? "ObjectEnd" : "AttributeEnd"; }

/// Error unless the innermost block is of this kind.
void require_open(const State& state, Block::Kind kind, const Location& where) {
  const Block& top = state.blocks.back();
  if (top.kind == kind) return;
  const std::string end = end_of(kind);
  if (top.kind == Block::Kind::world || top.kind == Block::Kind::import)
    throw Error(where, end + " closes nothing; remove it or add " + begin_of(kind) + " before");
  throw Error(where, end + " stands inside the " + begin_of(top.kind) + " of line " + std::to_string(top.opened.line) +
                         "; close that first with " + end_of(top.kind));
}

}  // namespace

void open_block(State& state, Block::Kind kind, const Location& where) {
  if (state.blocks.size() > kMaxDepth)
    throw Error(where, "blocks are nested deeper than " + std::to_string(kMaxDepth) + "; is an " + end_of(kind) + " missing?");
  state.blocks.push_back({kind, where, state.graphics, {}});
}

void close_block(State& state) {
  if (state.blocks.back().kind == Block::Kind::object) state.open_object.reset();
  state.graphics = std::move(state.blocks.back().saved);
  state.blocks.pop_back();
}

void require_closed(State& state, std::size_t depth) {
  if (state.blocks.size() <= depth) return;
  const Block::Kind kind = state.blocks.back().kind;
  const Location opened = state.blocks.back().opened;
  while (state.blocks.size() > depth) close_block(state);
  throw Error(opened, std::string(begin_of(kind)) + " is not closed; add " + end_of(kind));
}

void read_world_begin(State& state, Tokenizer&, const Location&) {
  state.in_world = true;
  state.world_assumed = false;
  state.graphics.ctm = Transform();
  state.graphics.singular.reset();
  state.graphics.start_active = true;
  state.coordinate_systems["world"] = {};
  finish_settings(state);
}

void read_attribute_begin(State& state, Tokenizer&, const Location& where) { open_block(state, Block::Kind::attribute, where); }

void read_attribute_end(State& state, Tokenizer&, const Location& where) {
  require_open(state, Block::Kind::attribute, where);
  close_block(state);
}

void read_transform_begin(State& state, Tokenizer& in, const Location& where) {
  state.reports.warn(where, "TransformBegin and TransformEnd are deprecated and act as AttributeBegin and AttributeEnd");
  read_attribute_begin(state, in, where);
}

void read_transform_end(State& state, Tokenizer& in, const Location& where) { read_attribute_end(state, in, where); }

void read_object_begin(State& state, Tokenizer& in, const Location& where) {
  const std::string name(in.expect_string("an object name").text);
  const bool nested = state.open_object.has_value();
  open_block(state, nested ? Block::Kind::attribute : Block::Kind::object, where);
  if (nested)
    throw Error(where, "ObjectBegin stands inside another object; objects cannot be nested, close the first with ObjectEnd");
  state.open_object = static_cast<ObjectId>(state.scene.objects.size());
  state.scene.objects.push_back({name, {}});
  if (!state.objects.try_emplace(name, *state.open_object).second)
    throw Error(where, "object \"" + printable(name) + "\" is defined twice; rename one");
}

void read_object_end(State& state, Tokenizer&, const Location& where) {
  require_open(state, Block::Kind::object, where);
  close_block(state);
}

void read_object_instance(State& state, Tokenizer& in, const Location& where) {
  const Token name = in.expect_string("an object name");
  if (state.open_object) throw Error(where, "ObjectInstance stands inside an object; put the shapes themselves there");
  const auto it = state.objects.find(std::string(name.text));
  if (it == state.objects.end())
    throw in.error(name.at, "object \"" + printable(name.text) + "\" is not defined; define it with ObjectBegin before line " +
                                std::to_string(name.at.line) + " (" + suggestion(name.text, names_of(state.objects)) + ")");
  state.scene.instances.push_back({it->second, usable_ctm(state, where)});
}

void read_attribute(State& state, Tokenizer& in, const Location&) {
  const Token target = in.expect_string("a target, as \"shape\"");
  std::vector<Param> params = read_params(in, state.graphics.color_space);
  auto defaults = std::make_shared<AttributeDefaults>(*state.graphics.defaults);
  std::vector<Param>* list = target.text == "shape"      ? &defaults->shape
                             : target.text == "light"    ? &defaults->light
                             : target.text == "material" ? &defaults->material
                             : target.text == "medium"   ? &defaults->medium
                             : target.text == "texture"  ? &defaults->texture
                                                         : nullptr;
  if (!list)
    throw in.error(target.at, "attribute target \"" + printable(target.text) + "\" is unknown; " +
                                  suggestion(target.text, {"shape", "light", "material", "medium", "texture"}));
  for (Param& p : params) {
    std::erase_if(*list, [&](const Param& old) { return old.name == p.name; });
    list->push_back(std::move(p));
  }
  state.graphics.defaults = std::move(defaults);
}

void read_reverse_orientation(State& state, Tokenizer&, const Location&) {
  state.graphics.reverse_orientation = !state.graphics.reverse_orientation;
}

void read_color_space(State& state, Tokenizer& in, const Location&) {
  const Token name = in.expect_string("a colour space");
  const ColorSpace* space = find_color_space(name.text);
  if (!space)
    throw in.error(name.at, "colour space \"" + printable(name.text) + "\" is unknown; " +
                                suggestion(name.text, {"srgb", "rec2020", "aces2065-1", "dci-p3"}));
  state.graphics.color_space = space;
}

}  // namespace tyndall::pbrt
