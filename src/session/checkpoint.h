/// A render's state as bytes: to be kept in a file and taken up again, by the same program for the same picture only.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "session/film_sums.h"
#include "transport/sample/counters.h"

namespace tyndall {

/// What a checkpoint belongs to, as (what, value): "scene", its hash ... All must agree for it to be taken up.
using CheckpointIdentity = std::vector<std::pair<std::string, std::string>>;

/// Everything that the samples done so far have left behind.
struct CheckpointState {
  int samples = 0;  ///< a pixel
  double seconds = 0;
  Counters counters;
  std::vector<std::uint64_t> plan{};  ///< SamplePlan::state(); empty: all pixels have as many
  std::vector<std::string> keyed{};   ///< KeyedSums::bytes(), of each layer
};

/// Ends in a hash of all that goes before it.
std::string encode_checkpoint(const CheckpointIdentity& identity, const CheckpointState& state, const FilmSums& sums);

/// The state, with a plan of `plan_size` numbers; the film's sums go to `sums`, which are left alone on failure. `name` stands
/// for the file in messages. Throws Error (scene) for bytes that are no checkpoint or damaged, and for a part of `identity`
/// that differs, with both values.
CheckpointState decode_checkpoint(std::string_view bytes, const std::string& name, const CheckpointIdentity& identity,
                                  FilmSums& sums, std::size_t plan_size = 0);

/// Throws Error (scene): the file `name` is damaged.
[[noreturn]] void refuse_checkpoint(const std::string& name);

/// What a checkpoint says of itself, whatever it belongs to. Throws as decode_checkpoint does.
struct CheckpointSummary {
  CheckpointIdentity identity;
  CheckpointState state;
};
CheckpointSummary peek_checkpoint(std::string_view bytes, const std::string& name);

}  // namespace tyndall
