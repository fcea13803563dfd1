#include <array>
#include <cmath>
#include <cstdio>

#include "report/image_diff.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

std::string plain_number(double v) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", v);
  return text.data();
}

/// "3 values of R in the image not finite, first at (1, 0)".
std::string describe(const BadValues& v, const std::string& what) {
  return std::to_string(v.count) + (v.count == 1 ? " value of " : " values of ") + v.channel +
         (v.in_reference ? " in the reference " : " in the image ") + what + ", first at (" + std::to_string(v.x) + ", " +
         std::to_string(v.y) + ")";
}

void judge_always(const ImageDiff& diff, std::vector<std::string>& reasons) {
  for (const BadValues& n : diff.non_finite) reasons.push_back(describe(n, "not finite"));
  for (const BadValues& n : diff.negative_variances) {
    reasons.push_back(describe(n, "negative") + ": a variance is 0 or more; render the image again");
  }
  for (const std::string& name : diff.only_in_image) reasons.push_back("channel " + name + " is in the image only");
  for (const std::string& name : diff.only_in_reference) reasons.push_back("channel " + name + " is in the reference only");
}

void judge_exact(const ImageDiff& diff, std::vector<std::string>& reasons) {
  for (const ChannelDiff& c : diff.channels) {
    if (!c.equal) {
      reasons.push_back("channel " + c.name + " is not equal: off by up to " + plain_number(c.largest) + " at (" +
                        std::to_string(c.x) + ", " + std::to_string(c.y) + ")");
    }
  }
}

void judge_error(const ImageDiff& diff, double limit, std::vector<std::string>& reasons) {
  for (const ChannelDiff& c : diff.channels) {
    if (is_statistic(c.name) || c.largest <= limit) continue;
    reasons.push_back("channel " + c.name + " is off by " + plain_number(c.largest) + " at (" + std::to_string(c.x) + ", " +
                      std::to_string(c.y) + "), more than " + plain_number(limit));
  }
}

void judge_relmse(const ImageDiff& diff, double limit, std::vector<std::string>& reasons) {
  for (const GroupDiff& g : diff.groups) {
    const double relmse = g.without_noise ? g.without_noise->relmse : g.errors.relmse;
    if (is_statistic(g.name) || relmse <= limit) continue;
    reasons.push_back("relMSE of " + g.name + " is " + plain_number(relmse) + ", more than " + plain_number(limit));
  }
}

void judge_flip(const ImageDiff& diff, double limit, std::vector<std::string>& reasons) {
  if (!diff.flip_hdr) {
    if (!diff.non_finite.empty()) return;  // a difference in itself
    throw Error(Failure::usage, "--max-flip needs R, G and B in both images and no --no-flip; choose another criterion");
  }
  const double mean = diff.flip_hdr->mean();
  if (!(mean <= limit)) reasons.push_back("mean HDR-FLIP is " + plain_number(mean) + ", more than " + plain_number(limit));
}

void judge_test(const ImageDiff& diff, std::vector<std::string>& reasons) {
  if (!diff.test) {
    if (!diff.negative_variances.empty()) return;  // a difference in itself
    throw Error(Failure::usage,
                "--test needs R, G, B and their Variance in both images; render them with --aov Variance, or choose "
                "--max-relmse, --max-error, --max-flip or --exact");
  }
  if (!diff.test->same) reasons.push_back("RGB by the image test " + diff.test->verdict);
}

/// With the default made explicit.
Criteria resolved(const ImageDiff& diff, Criteria criteria) {
  const bool none = !criteria.test && !criteria.exact && !criteria.max_error && !criteria.max_relmse && !criteria.max_flip;
  if (none) (diff.test || !diff.negative_variances.empty() ? criteria.test : criteria.exact) = true;
  return criteria;
}

std::string options_of(const Criteria& c) {
  std::string options;
  if (c.test) options += " --test";
  if (c.exact) options += " --exact";
  if (c.max_error) options += " --max-error " + plain_number(*c.max_error);
  if (c.max_relmse) options += " --max-relmse " + plain_number(*c.max_relmse);
  if (c.max_flip) options += " --max-flip " + plain_number(*c.max_flip);
  return options.substr(1);
}

}  // namespace

Judgement judge(const ImageDiff& diff, const Criteria& wanted) {
  const Criteria criteria = resolved(diff, wanted);
  Judgement judgement;
  judgement.criterion = options_of(criteria);
  std::vector<std::string>& reasons = judgement.reasons;
  if (!diff.windows.empty()) {
    reasons.push_back("data windows: " + diff.windows);
    return judgement;
  }
  judge_always(diff, reasons);
  if (criteria.test) judge_test(diff, reasons);
  if (criteria.exact) judge_exact(diff, reasons);
  if (criteria.max_error) judge_error(diff, *criteria.max_error, reasons);
  if (criteria.max_relmse) judge_relmse(diff, *criteria.max_relmse, reasons);
  if (criteria.max_flip) judge_flip(diff, *criteria.max_flip, reasons);
  judgement.same = reasons.empty();
  return judgement;
}

}  // namespace tyndall
