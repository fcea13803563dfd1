#include "session/build_id.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include "math/stream_hash.h"
#include "tyndall/version.h"

namespace tyndall {
namespace {

constexpr std::array<std::string_view, 6> kReckoning{"libembree", "libopenvdb", "libOpenEXR", "libImath", "libm.", "libc."};

std::string hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    text += digits;
  }
  return text;
}

/// The GNU build identity among `notes`, each a header, a name and a description, these two padded to four bytes
/// [System V ABI, Note Section]; empty when there is none.
std::string identity_among(std::string_view notes) {
  const auto padded = [](std::size_t size) { return (size + 3) & ~std::size_t{3}; };
  ElfW(Nhdr) head{};
  while (notes.size() >= sizeof head) {
    std::memcpy(&head, notes.data(), sizeof head);
    const std::size_t at = sizeof head + padded(head.n_namesz), end = at + padded(head.n_descsz);
    if (end > notes.size()) break;
    const std::string_view name = notes.substr(sizeof head, head.n_namesz);
    if (head.n_type == NT_GNU_BUILD_ID && name == std::string_view("GNU", 4))
      return hexadecimal(notes.substr(at, head.n_descsz));
    notes.remove_prefix(end);
  }
  return "";
}

int add_library(dl_phdr_info* info, std::size_t, void* to) {
  std::string_view name = info->dlpi_name;
  name.remove_prefix(name.find_last_of('/') + 1);  // npos + 1 = 0
  if (std::none_of(kReckoning.begin(), kReckoning.end(), [&](auto prefix) { return name.starts_with(prefix); })) return 0;
  LoadedLibrary library{std::string(name), ""};
  for (std::size_t i = 0; i < info->dlpi_phnum && library.id.empty(); ++i) {
    const ElfW(Phdr)& part = info->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    library.id = identity_among({reinterpret_cast<const char*>(info->dlpi_addr + part.p_vaddr), part.p_memsz});
  }
  static_cast<std::vector<LoadedLibrary>*>(to)->push_back(std::move(library));
  return 0;
}

std::uint64_t hash_of_program() {
  StreamHash hash;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/proc/self/exe", "rb"),
                                                             [](std::FILE* f) { return f ? std::fclose(f) : 0; });
  std::vector<char> buffer(std::size_t{1} << 18);
  while (const std::size_t got = file ? std::fread(buffer.data(), 1, buffer.size(), file.get()) : 0)
    hash.add(buffer.data(), got);
  return hash.value();
}

std::uint64_t hash_of_libraries() {
  StreamHash hash;
  for (const LoadedLibrary& library : reckoning_libraries()) {
    const std::string text = library.name + " " + library.id + "\n";
    hash.add(text.data(), text.size());
  }
  return hash.value();
}

}  // namespace

std::vector<LoadedLibrary> reckoning_libraries() {
  std::vector<LoadedLibrary> libraries;
  dl_iterate_phdr(add_library, &libraries);
  std::sort(libraries.begin(), libraries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return libraries;
}

const std::string& build_id() {
  static const std::string id = std::string(kVersion) + "-" + hex_text(hash_of_program()) + "-" + hex_text(hash_of_libraries());
  return id;
}

}  // namespace tyndall
