#include "io/pbrt_params.h"

#include <algorithm>
#include <utility>

#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

std::string list_of(std::initializer_list<ParamType> types) {
  std::string out;
  for (const ParamType type : types) {
    if (!out.empty()) out += type == *(types.end() - 1) ? " or " : ", ";
    out += name_of(type);
  }
  return out;
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::size_t count_of(const Param& p) { return p.numbers.size() + p.integers.size() + p.strings.size(); }

}  // namespace

ParamList::ParamList(std::string owner, Location where, std::vector<Param> params, const std::vector<Param>* defaults,
                     Reports& reports)
    : owner_(std::move(owner)), where_(std::move(where)), params_(std::move(params)), defaults_(defaults), reports_(&reports) {}

const Param* ParamList::look(std::string_view name) const {
  for (const Param& p : params_)
    if (p.name == name) return &p;
  for (const Param& p : borrowed_)
    if (p.name == name) return &p;
  if (defaults_)
    for (const Param& p : *defaults_)
      if (p.name == name) return &p;
  return nullptr;
}

Param* ParamList::find(std::string_view name, std::initializer_list<ParamType> types) {
  asked_.push_back(name);
  const Param* p = look(name);
  if (!p) return nullptr;
  if (std::find(types.begin(), types.end(), p->type) == types.end())
    throw Error(p->where, "parameter " + in_quotes(name) + " of " + owner_ + " is a " + list_of(types) + ", not a " +
                              std::string(name_of(p->type)) + "; change its type");
  const auto own = [&](auto& list) { return std::find_if(list.begin(), list.end(), [&](const Param& q) { return &q == p; }); };
  if (const auto it = own(params_); it != params_.end()) return &*it;
  if (const auto it = own(borrowed_); it != borrowed_.end()) return &*it;
  return &borrowed_.emplace_back(*p);
}

Param* ParamList::one(std::string_view name, ParamType type) {
  Param* p = find(name, {type});
  if (!p) return nullptr;
  const bool triple = type == ParamType::point3 || type == ParamType::vector3;
  if (count_of(*p) != (triple ? 3 : 1))
    throw Error(p->where, "parameter " + in_quotes(name) + " has more than one value; give one");
  return p;
}

float ParamList::number(std::string_view name, float otherwise) { return maybe_number(name).value_or(otherwise); }

float ParamList::not_negative(std::string_view name, float otherwise) {
  const float value = number(name, otherwise);
  if (value < 0) throw error(name, std::string(name) + " must not be negative; use 0 or more");
  return value;
}

std::optional<float> ParamList::maybe_number(std::string_view name) {
  const Param* p = one(name, ParamType::number);
  return p ? std::optional(p->numbers[0]) : std::nullopt;
}

int ParamList::integer(std::string_view name, int otherwise) {
  const Param* p = one(name, ParamType::integer);
  return p ? p->integers[0] : otherwise;
}

bool ParamList::boolean(std::string_view name, bool otherwise) {
  const Param* p = one(name, ParamType::boolean);
  return p ? p->integers[0] != 0 : otherwise;
}

std::string ParamList::string(std::string_view name, std::string_view otherwise) {
  const Param* p = one(name, ParamType::string);
  return p ? p->strings[0] : std::string(otherwise);
}

Vec3 ParamList::point(std::string_view name, Vec3 otherwise) {
  const Param* p = one(name, ParamType::point3);
  return p ? Vec3{p->numbers[0], p->numbers[1], p->numbers[2]} : otherwise;
}

Vec3 ParamList::vector(std::string_view name, Vec3 otherwise) {
  const Param* p = one(name, ParamType::vector3);
  return p ? Vec3{p->numbers[0], p->numbers[1], p->numbers[2]} : otherwise;
}

std::vector<float> ParamList::numbers(std::string_view name) {
  Param* p = find(name, {ParamType::number});
  return p ? std::move(p->numbers) : std::vector<float>{};
}

std::vector<std::int32_t> ParamList::integers(std::string_view name) {
  Param* p = find(name, {ParamType::integer});
  return p ? std::move(p->integers) : std::vector<std::int32_t>{};
}

std::vector<std::string> ParamList::strings(std::string_view name) {
  Param* p = find(name, {ParamType::string});
  return p ? std::move(p->strings) : std::vector<std::string>{};
}

std::vector<Vec3> ParamList::triples(std::string_view name, ParamType type) {
  const Param* p = find(name, {type});
  std::vector<Vec3> out(p ? p->numbers.size() / 3 : 0);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {p->numbers[3 * i], p->numbers[3 * i + 1], p->numbers[3 * i + 2]};
  return out;
}

std::vector<Vec2> ParamList::pairs(std::string_view name) {
  const Param* p = find(name, {ParamType::point2});
  std::vector<Vec2> out(p ? p->numbers.size() / 2 : 0);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {p->numbers[2 * i], p->numbers[2 * i + 1]};
  return out;
}

std::string ParamList::choice(std::string_view name, std::string_view otherwise,
                              std::initializer_list<std::string_view> choices) {
  const std::string value = string(name, otherwise);
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return value;
  const std::vector<std::string> known(choices.begin(), choices.end());
  throw error(name, in_quotes(printable(value)) + " is no " + std::string(name) + "; " + suggestion(value, known));
}

void ParamList::ignore(std::string_view name, std::initializer_list<ParamType> types, std::string_view reason) {
  const Param* p = find(name, types);
  if (p) reports_->warn(p->where, "parameter " + in_quotes(name) + " of " + owner_ + " is ignored: " + std::string(reason));
}

void ParamList::finish() const {
  for (const Param& p : params_) {
    if (std::find(asked_.begin(), asked_.end(), p.name) != asked_.end()) continue;
    std::vector<std::string> known(asked_.begin(), asked_.end());
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    throw Error(p.where, owner_ + " has no parameter " + in_quotes(p.name) + "; " + suggestion(p.name, known));
  }
}

Location ParamList::where(std::string_view name) const {
  const Param* p = look(name);
  return p ? p->where : where_;
}

Error ParamList::error(std::string_view name, const std::string& message) const { return Error(where(name), message); }

}  // namespace tyndall::pbrt
