#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "io/file_text.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

struct Inflater {
  z_stream stream{};
  Inflater() { inflateInit2(&stream, 15 + 16); }  // 16: a gzip header, not a zlib one
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

Error damaged(const std::string& path, const std::string& what) {
  return Error(Failure::scene, path + ": " + what + "; compress the file again");
}

/// Appends one gzip member to `out` and returns how many input bytes it took.
std::size_t inflate_member(std::string_view bytes, const std::string& path, std::size_t limit, std::string& out) {
  constexpr std::size_t kMaxStep = std::numeric_limits<uInt>::max();
  Inflater inflater;
  z_stream& z = inflater.stream;
  std::size_t taken = 0;
  int status = Z_OK;
  std::string block(std::size_t{1} << 18, '\0');
  while (status != Z_STREAM_END) {
    const std::size_t step = std::min(bytes.size() - taken, kMaxStep);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
    z.avail_in = static_cast<uInt>(step);
    z.next_out = reinterpret_cast<Bytef*>(block.data());
    z.avail_out = static_cast<uInt>(block.size());
    status = inflate(&z, Z_NO_FLUSH);
    if (status == Z_BUF_ERROR) throw damaged(path, "gzip data ends too early");
    if (status != Z_OK && status != Z_STREAM_END) throw damaged(path, "gzip data is damaged");
    taken += step - z.avail_in;
    const std::size_t made = block.size() - z.avail_out;
    if (out.size() + made > limit)
      throw Error(Failure::scene, path + ": unfolds to more than " + std::to_string(limit >> 20) + " MB; refused");
    out.append(block, 0, made);
  }
  return taken;
}

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

std::string gunzip(std::string_view bytes, const std::string& path, std::size_t limit) {
  std::string out;
  while (is_gzip(bytes)) bytes.remove_prefix(inflate_member(bytes, path, limit, out));
  return out;
}

}  // namespace tyndall
