#include "tyndall/volume_io.h"
#include "volume/vdb_file.h"

namespace tyndall {

Description describe_volume(const std::string& path) {
  const std::unique_ptr<VolumeFile> file = open_volume(path);
  Description description{path, file->format(), {}};
  for (const auto& [name, value] : file->properties()) description.properties.push_back({"file", name, value});

  const std::vector<VolumeGridEntry>& grids = file->grids();
  for (std::size_t i = 0; i < grids.size(); ++i) {
    // Later grids of one name are told apart as OpenVDB does it, and as gridname accepts it.
    std::size_t earlier = 0;
    for (std::size_t j = 0; j < i; ++j) earlier += grids[j].name == grids[i].name ? 1 : 0;
    std::string subject = printable(grids[i].name);
    if (earlier > 0) subject += "[" + std::to_string(earlier) + "]";
    for (const auto& [name, value] : file->describe(i)) description.properties.push_back({subject, name, value});
  }
  return description;
}

}  // namespace tyndall
