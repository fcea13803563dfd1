/// The table of directives.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

struct Directive {
  enum class Scope { options, world, anywhere };  ///< before WorldBegin, after it, both
  std::string_view name;
  Scope scope;
  void (*read)(State&, Tokenizer&, const Location&);  ///< null for Include and Import, which the reader follows itself
};

const Directive* find_directive(std::string_view name);  ///< null when unknown
std::vector<std::string> directive_names();

/// Error when the directive may not stand where the reading is. Without WorldBegin only the first is one.
void check_scope(const Directive& directive, State& state, const Location& where);

}  // namespace tyndall::pbrt
