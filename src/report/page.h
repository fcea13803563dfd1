/// Reports to look at: one HTML file each, with everything in it, that works from disk and without a network.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// A picture of a page: R, G and B (or Y) of `image`, linear Rec.709, kept as half floats (3 significant digits).
struct PagePicture {
  enum class Kind { light, samples };  ///< what its values are
  std::string group;                   ///< the case of a regression suite; "" in a comparison
  std::string name;                    ///< a variant's name, "reference" or "render"
  Image image;
  Kind kind = Kind::light;
};

/// The page of a comparison: plots of the error, table of the variants, pictures. `results` is the object of
/// results.json; it is embedded as it is, and every number on the page is read from it. A field that is null or absent
/// is shown as a dash. Throws Error when a picture has no pixels or no colour.
std::string compare_page(const nlohmann::ordered_json& results, const std::vector<PagePicture>& pictures);

/// The page of a regression suite: failures first, the tests and the pictures of each case. Otherwise as compare_page.
std::string regress_page(const nlohmann::ordered_json& results, const std::vector<PagePicture>& pictures);

/// The page of a render that goes on, which asks its server for state and pictures. `start` holds its "title" and the "token"
/// of requests that change something. `nonce`: of the script, for a content security policy.
std::string live_page(const nlohmann::ordered_json& start, const std::string& nonce);

}  // namespace tyndall
