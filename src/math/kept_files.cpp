#include <sys/stat.h>

#include "tyndall/frames.h"

namespace tyndall {
namespace {

/// Differs when the file was written to or another one took its name; empty when there is none.
std::string stamp_of(const std::string& path) {
  struct stat s {};
  if (::stat(path.c_str(), &s) != 0) return {};
  std::string stamp;
  for (const auto number :
       {static_cast<long long>(s.st_dev), static_cast<long long>(s.st_ino), static_cast<long long>(s.st_size),
        static_cast<long long>(s.st_mtim.tv_sec), static_cast<long long>(s.st_mtim.tv_nsec)})
    stamp += std::to_string(number) + " ";
  return stamp;
}

}  // namespace

KeptFiles::Made KeptFiles::find_or_make(const Use& use, const std::function<Made()>& make) {
  wanted_.insert(use.path);
  const std::string of_file = stamp_of(use.path), stamp = of_file + use.details;
  const auto key = std::pair(use.path, use.name);
  const auto found = entries_.find(key);
  if (found != entries_.end() && found->second.stamp == stamp) {
    ++reused_;
    return found->second.made;
  }
  if (found != entries_.end()) entries_.erase(found);  // before there are two
  ++made_;
  Made made = make();
  if (!of_file.empty()) entries_[key] = {stamp, made};
  return made;
}

void KeptFiles::begin_scene() { wanted_.clear(); }

void KeptFiles::drop_others() {
  std::erase_if(entries_, [this](const auto& entry) { return !wanted_.contains(entry.first.first); });
}

}  // namespace tyndall
