/// Files: scenes in, images in and out, and a description of what a file holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/image_format.h"
#include "tyndall/scene.h"

namespace tyndall {

class KeptFiles;  // frames.h

/// Something worth saying that is no error: an option that is known and not honoured, say.
struct Warning {
  Location where;
  std::string message;
};

/// A file's name in a scene that holds a frame's number (names_frame in frames.h).
struct FrameName {
  Location where;
  std::string folder, name;  ///< the name alone holds the number
  bool holds_scene = false;  ///< an included file: other frames may name other files in it
};

struct SceneFile {
  Scene scene;
  std::vector<Warning> warnings;
  std::vector<FrameName> frame_names{};  ///< none: every frame has the same scene
};

/// How the scene of one frame is read.
struct SceneReading {
  std::optional<int> frame{};  ///< takes the place of %04d and $F4 in the names of files; without one they stay as they are
  KeptFiles* kept = nullptr;   ///< meshes of files are taken from it
};

/// Read a pbrt-v4 scene (.pbrt, .pbrt.gz). Throws Error (Failure::scene) at the first problem.
SceneFile read_scene(const std::string& path, const SceneReading& how = {});

/// Throws Error (scene), with the name of the file, for the first frame that lacks one. `file`: the scene at `path` as read for
/// another frame.
void require_frame(const SceneFile& file, const std::string& path, int frame);

/// Read a scene from text; `name` stands for the file in messages, relative paths start at `folder`.
SceneFile read_scene_text(const std::string& text, const std::string& name, const std::string& folder = ".");

/// Read as much as can be read and list every problem found, best first in file order. Empty: the scene reads.
struct SceneCheck {
  Scene scene;  ///< what could be read
  std::vector<std::string> errors;
  std::vector<Warning> warnings;
  std::vector<FrameName> frame_names{};
};
SceneCheck check_scene(const std::string& path, const SceneReading& how = {});

/// Read .exr (scanline or tiled, flat; of several parts with one data window the channels of all), .png, .pfm, .hdr, .jpg,
/// .tga, .bmp by content, not by name. Integers are made linear by `encoding`: "" for pictures, whose colours are sRGB; "sRGB",
/// "linear" or "gamma 2.2" for textures, whose alpha goes by it too, as in pbrt-v4. Throws Error (scene).
Image read_image(const std::string& path, const std::string& encoding = "");

/// The most threads that pack and unpack a large .exr, in the whole program; <= 0, as it starts: one a core, 8 at most.
void limit_image_threads(int threads);

/// What the header of an image file declares; no pixel is read. Throws Error (scene).
struct ImageSize {
  int width = 0, height = 0;
};
ImageSize read_image_size(const std::string& path);

/// The intensities of a luminaire by direction, type C: a row of candela a horizontal angle, in it one a vertical angle.
/// Vertical angles are 0 straight down and 180 straight up. The range of the horizontal ones says what is symmetric: one angle:
/// all around, to 90: quadrants, to 180 or from 90 to 270: both sides, to 360: nothing.
struct PhotometricWeb {
  std::vector<float> vertical_degrees, horizontal_degrees;  ///< increasing
  std::vector<float> candela;                               ///< of the luminaire: all its lamps, and the file's factors
};
/// Read an IES LM-63 file of photometric type C. Throws Error (scene) with the place in the file.
PhotometricWeb read_ies(const std::string& path);
/// The same from text; `name` stands for the file in messages.
PhotometricWeb read_ies_text(std::string_view text, const std::string& name);

/// The header of an .exr that read_image reads: windows, attributes, and channels without values. Throws Error (scene).
Image read_exr_header(const std::string& path);

/// Write an OpenEXR file: to a temporary name in the same folder, closed, read back and compared, renamed.
/// Throws Error (output) and leaves an existing file as it was.
void write_exr(const Image& image, const std::string& path, const ExrSettings& settings = {});
/// The bytes of an 8-bit PNG of R G B for sRGB displays; colours of other primaries than Rec.709's are converted. Throws Error
/// (output) when there is nothing to encode.
std::string encode_png(const Image& image, const PngSettings& settings = {});
/// Write these bytes.
void write_png(const Image& image, const std::string& path, const PngSettings& settings = {});
/// Write R G B (or Y) as a portable float map, little-endian.
void write_pfm(const Image& image, const std::string& path);

/// Whether write_image knows the ending of `path`: .exr, .png or .pfm.
bool is_written_image(const std::string& path);
/// Write the image as the ending of `path` says. Throws Error: usage for another ending, output.
void write_image(const Image& image, const std::string& path, const ImageFormat& format = {});

/// A binary polygon file (.ply) of the mesh: float positions, with normals and uvs when there are any, 32-bit indices.
/// Throws Error (output) for a mesh without triangles, or whose indices or counts do not agree.
std::string encode_ply(const TriangleMesh& mesh);
/// Write bytes as they are, in the same safe way as an image. Throws Error (output).
void write_file(std::string_view bytes, const std::string& path);
/// The bytes of a file, gzip undone. Throws Error (scene) when it is missing or cannot be read.
std::string read_file(const std::string& path);
/// Bytes that a new file at `path` could take: by the free space of its disk and the limit on the size of files. The
/// largest number when neither is known.
std::uint64_t room_for_file(const std::string& path);

/// What a .vdb, .nvdb, .exr (or other image) or .pbrt holds: rows of (subject, property, value).
struct Property {
  std::string subject, name, value;
};
struct Description {
  std::string path, kind;
  std::vector<Property> properties;
};
/// Throws Error (scene) when the file cannot be read.
Description describe(const std::string& path);

}  // namespace tyndall
