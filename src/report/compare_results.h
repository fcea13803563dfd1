/// A comparison as results.json and error.csv.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "report/compare.h"

namespace tyndall {

/// What the results should say of where they come from.
struct CompareContext {
  std::string scene, options, command;
  int width = 0, height = 0, threads = 0;
};

/// File name of a variant's picture: its name with what file systems dislike replaced, and ".exr".
std::string picture_file(const std::string& variant_name);

nlohmann::ordered_json compare_json(const CompareContext& context, const ComparePlan& plan, const Reference& reference,
                                    const CompareResult& result);
/// variant,seconds,samples,mse,relmse,relmse_low,relmse_high: a line for each point of each curve.
std::string error_csv(const CompareResult& result);
/// For a terminal: a line a variant.
std::string compare_table(const CompareResult& result);

}  // namespace tyndall
