/// The directives that open and close blocks, instance objects and set the state for what follows.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_world_begin(State& state, Tokenizer& in, const Location& where);
void read_attribute_begin(State& state, Tokenizer& in, const Location& where);
void read_attribute_end(State& state, Tokenizer& in, const Location& where);
void read_transform_begin(State& state, Tokenizer& in, const Location& where);  ///< deprecated, as AttributeBegin
void read_transform_end(State& state, Tokenizer& in, const Location& where);
void read_object_begin(State& state, Tokenizer& in, const Location& where);
void read_object_end(State& state, Tokenizer& in, const Location& where);
void read_object_instance(State& state, Tokenizer& in, const Location& where);
void read_attribute(State& state, Tokenizer& in, const Location& where);
void read_reverse_orientation(State& state, Tokenizer& in, const Location& where);
void read_color_space(State& state, Tokenizer& in, const Location& where);

void open_block(State& state, Block::Kind kind, const Location& where);
void close_block(State& state);  ///< restores the graphics state
/// Error for the innermost block above `depth`, which the end of the file finds open; closes all of them first.
void require_closed(State& state, std::size_t depth);

}  // namespace tyndall::pbrt
