/// What `tyndall diff` prints.
#pragma once

#include <string>

#include "report/image_diff.h"

namespace tyndall::cli {

struct DiffOptions {
  std::string image, reference, picture;  ///< files; picture "": none
  DiffSettings settings;
  Criteria criteria;
  bool json = false;
};

std::string as_text(const ImageDiff& diff, const Judgement& judgement, const DiffOptions& options);
std::string as_json(const ImageDiff& diff, const Judgement& judgement, const DiffOptions& options);

}  // namespace tyndall::cli
