/// The container of .nvdb files: headers checked, grids decompressed. Values are looked at in vdb_nanovdb.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/HostBuffer.h>

namespace tyndall {

/// A grid as it lies in the file, in memory aligned for NanoVDB; its head is checked, its tree is not.
struct NanoBlob {
  nanovdb::HostBuffer bytes;
  std::string codec;
  std::string name;

  const nanovdb::GridData& head() const { return *reinterpret_cast<const nanovdb::GridData*>(bytes.data()); }
};

struct NanoFile {
  std::string version;
  std::vector<NanoBlob> grids;
};

/// Throws Error (scene) when the file is not wholly what its headers say, or its grids take more than `most_memory` bytes.
NanoFile read_nano_file(const std::string& path, std::size_t most_memory);

std::string nano_version(std::uint32_t packed);  ///< "32.4.2"

}  // namespace tyndall
