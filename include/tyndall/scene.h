/// A scene as plain data: written by hand in C++, or read from a file by read_scene (io.h).
///
/// Nothing here is ready to render; `build` (render.h) turns it into a World. Directives, defaults and
/// units are those of the pbrt-v4 scene format. Colours are linear Rec.709 RGB (spectra and other
/// colour spaces are converted by the reader), lengths scene units, angles degrees where the name says so.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tyndall/error.h"
#include "tyndall/image.h"
#include "tyndall/lights.h"
#include "tyndall/math.h"
#include "tyndall/phase.h"
#include "tyndall/settings.h"

namespace tyndall {

using TextureId = std::uint32_t;   ///< index into Scene::textures
using MaterialId = std::uint32_t;  ///< index into Scene::materials
using MediumId = std::uint32_t;    ///< index into Scene::media
using BoundaryId = std::uint32_t;  ///< index into Scene::boundaries
using ObjectId = std::uint32_t;    ///< index into Scene::objects

// ---------------------------------------------------------------------------------------------- textures

/// From surface to texture coordinates.
struct TextureMapping {
  enum class Kind { uv, spherical, cylindrical, planar } kind = Kind::uv;
  Vec2 scale{1, 1}, offset{0, 0};  ///< uv: (su,sv), (du,dv); planar: offset (udelta,vdelta)
  Vec3 v1{1, 0, 0}, v2{0, 1, 0};   ///< planar
  Transform to_texture;            ///< world to texture space; spherical, cylindrical, planar and 3D checkerboard
};

struct ConstantTexture {
  Rgb value;
};
struct ScaleTexture {
  TextureId texture, scale;
};
struct MixTexture {
  TextureId first, second, amount;  ///< (1 - amount) first + amount second
};
struct ImageTexture {
  enum class Wrap { repeat, black, clamp, octahedral } wrap = Wrap::repeat;  ///< octahedral: mirrored across the edges
  enum class Filter { point, bilinear, trilinear, elliptical } filter = Filter::bilinear;
  float max_anisotropy = 8;  ///< of the elliptical filter
  std::string path;
  TextureMapping mapping;
  float scale = 1;
  bool invert = false;
  /// How 8-bit values become linear: "" = by file kind (8-bit: sRGB), else pbrt's "sRGB", "linear", "gamma <g>".
  std::string encoding;
  /// Row-major 3x3 taking the file's linear RGB to Rec.709.
  std::array<float, 9> to_rec709{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool is_data = false;  ///< numbers and no colours (a normal map): primaries that the file names are passed over
};
struct CheckerboardTexture {
  int dimension = 2;  ///< 2: over mapping's st; 3: over the texture-space point
  TextureMapping mapping;
  TextureId first, second;
};
/// Discs of `inside`, one in about half of the unit cells of mapping's st.
struct DotsTexture {
  TextureMapping mapping;
  TextureId inside, outside;
};
/// Bilinear between four corners of mapping's st, and beyond them: v01 is at s = 0, t = 1.
struct BilerpTexture {
  TextureMapping mapping;
  Rgb v00{0.0f}, v01{1.0f}, v10{0.0f}, v11{1.0f};
};
/// |n . direction| first + the rest second, n being the geometric normal.
struct DirectionMixTexture {
  TextureId first, second;
  Vec3 direction;  ///< unit, world space
};
/// Sums of Perlin noise over the texture-space point, as pbrt has them.
struct NoiseTexture {
  enum class Kind { fbm, wrinkled, windy, marble } kind = Kind::fbm;
  Transform to_texture;  ///< from world space
  int octaves = 8;       ///< not of windy
  float roughness = 0.5f;
  float scale = 1, variation = 0.2f;  ///< marble alone
};
/// Every texture gives an Rgb; scalar parameters use the mean of its channels.
struct Texture {
  std::variant<ConstantTexture, ScaleTexture, MixTexture, ImageTexture, CheckerboardTexture, DotsTexture, BilerpTexture,
               DirectionMixTexture, NoiseTexture>
      kind;
  Location where;
};

// --------------------------------------------------------------------------------------------- materials

struct Roughness {
  TextureId u, v;     ///< GGX roughness along the tangent and bitangent
  bool remap = true;  ///< alpha = sqrt(roughness), as pbrt's remaproughness; false: alpha = roughness
};
/// Complex index of refraction eta + i k per channel, or a normal-incidence reflectance (k derived).
struct ConductorOptics {
  std::optional<TextureId> reflectance;
  TextureId eta = 0, k = 0;  ///< used when reflectance is absent
};
struct DiffuseMaterial {
  TextureId reflectance;
};
struct ConductorMaterial {
  ConductorOptics optics;
  Roughness roughness;
};
struct DielectricMaterial {
  float eta = 1.5f;
  Roughness roughness;
  /// Dispersion: the index for each channel. A path that meets it goes on with one channel, of three times the weight.
  std::optional<Rgb> eta_rgb{};
};
struct ThinDielectricMaterial {
  float eta = 1.5f;
};
struct DiffuseTransmissionMaterial {
  TextureId reflectance, transmittance;
  float scale = 1;
};
/// The layer over a coated material and the controls of its stochastic walk, with pbrt's meanings.
struct Coating {
  Roughness roughness;
  TextureId thickness;
  float eta = 1.5f;
  TextureId g, albedo;  ///< of the medium between the interfaces
  int max_depth = 10;
  int samples = 1;
};
struct CoatedDiffuseMaterial {
  TextureId reflectance;
  Coating coating;
};
struct CoatedConductorMaterial {
  ConductorOptics optics;
  Roughness conductor_roughness;
  Coating coating;
};
struct MixMaterial {
  MaterialId first, second;
  TextureId amount;  ///< probability of `second`
};
struct InterfaceMaterial {};  ///< no optical effect; bounds media only

struct Material {
  std::variant<DiffuseMaterial, ConductorMaterial, DielectricMaterial, ThinDielectricMaterial, DiffuseTransmissionMaterial,
               CoatedDiffuseMaterial, CoatedConductorMaterial, MixMaterial, InterfaceMaterial>
      kind;
  std::string name;  ///< empty unless a named material
  Location where;
  /// What bends the shading normal, for mixes in their parts: a height in world units, or an image (is_data) of normals in
  /// the frame of dp/du and the shading normal, components from [-1, 1] to [0, 1].
  std::optional<TextureId> displacement{}, normal_map{};
  float displacement_scale = 1;  ///< world units for each unit of the displacement
};

// ------------------------------------------------------------------------------------------------- media

/// Coefficients in 1/scene unit at density 1, already multiplied by the medium's `scale`.
struct MediumOptics {
  Rgb sigma_a{1.0f}, sigma_s{1.0f};
  Phase phase = HenyeyGreenstein{};
};
struct HomogeneousMedium {
  Rgb Le;  ///< radiance scale of emission sigma_a * Le
};
/// nx*ny*nz samples at the centres of equal cells of `bounds` (medium space), x fastest; trilinear, zero outside.
struct UniformGridMedium {
  Bounds3 bounds{{0, 0, 0}, {1, 1, 1}};
  int nx = 1, ny = 1, nz = 1;
  std::vector<float> density;
  std::vector<float> Le_scale;     ///< empty: 1 everywhere
  std::vector<float> temperature;  ///< empty: none; else Le = Le_factor * blackbody_rgb(kelvin)
  Rgb Le;                          ///< constant emission colour; ignored when temperature is given
  float Le_factor = 1;
  /// kelvin = (value - offset) * scale, where the value is interpolated.
  float temperature_scale = 1, temperature_offset = 0;
};
struct RgbGridMedium {
  Bounds3 bounds{{0, 0, 0}, {1, 1, 1}};
  int nx = 1, ny = 1, nz = 1;
  std::vector<Rgb> sigma_a, sigma_s;  ///< empty: 1 everywhere (as pbrt); multiplied by `scale`
  std::vector<Rgb> Le;                ///< empty: none
  float scale = 1;
};
/// Perlin-noise cloud, pbrt's CloudMedium.
struct CloudMedium {
  Bounds3 bounds{{0, 0, 0}, {1, 1, 1}};
  float density = 1, wispiness = 1, frequency = 5;
};
/// An OpenVDB (.vdb) or NanoVDB (.nvdb) file.
struct VdbMedium {
  std::string path;
  std::string density_grid = "density";  ///< a name, else the first alias found
  std::string temperature_grid = "temperature";
  std::string flame_grid;  ///< empty: not read
  bool density_grid_given = false, temperature_grid_given = false;
  float temperature_scale = 1, temperature_offset = 0;  ///< kelvin = (value - offset) * scale
  float Le_scale = 1;
  Rgb Le{1.0f};                 ///< colour of flame emission sigma_a * Le_scale * Le * flame where no temperature emits
  bool emission_given = false;  ///< the scene speaks of emission: without any there is a warning
};
struct Medium {
  std::variant<HomogeneousMedium, UniformGridMedium, RgbGridMedium, CloudMedium, VdbMedium> kind;
  MediumOptics optics;
  Transform to_world;
  std::string name;
  Location where;
  std::string group{};  ///< light group of its emission, as of a Light
};
/// All shapes with the same (inside, outside) media within one attribute block or object: one closed boundary.
/// The geometric normal points outside.
struct Boundary {
  std::optional<MediumId> inside, outside;
};

// ------------------------------------------------------------------------------------------------ shapes

/// Object-space triangles. Empty normals or uvs: none.
struct TriangleMesh {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uvs;
  std::vector<std::uint32_t> indices;  ///< three a triangle
};
/// Object-space bilinear patches, vertex order as pbrt: (0,0) (1,0) (0,1) (1,1).
struct BilinearMesh {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uvs;
  std::vector<std::uint32_t> indices;  ///< four a patch
};
struct Sphere {
  float radius = 1, z_min = -1, z_max = 1, phi_max_degrees = 360;
};
struct Disk {
  float height = 0, radius = 1, inner_radius = 0, phi_max_degrees = 360;
};
struct Cylinder {
  float radius = 1, z_min = -1, z_max = 1, phi_max_degrees = 360;
};
struct Shape {
  std::variant<TriangleMesh, BilinearMesh, Sphere, Disk, Cylinder> kind{};
  Transform to_world{};  ///< to object-definition space inside an Object
  bool reverse_orientation = false;
  MaterialId material = 0;
  std::optional<AreaLight> emission{};
  std::optional<BoundaryId> boundary{};  ///< set when the media on the two sides differ
  std::optional<TextureId> alpha{};      ///< opacity, [0,1]
  Location where{};
  std::string name{};  ///< of the object that it is of, for mattes (cryptomatte.h); empty: it goes by its Object, or its place
};
struct Object {
  std::string name;
  std::vector<Shape> shapes;
};
struct Instance {
  ObjectId object;
  Transform to_world;
};

// ------------------------------------------------------------------------------------- camera, film, whole

/// One surface of a lens, or the stop. Lengths in camera space, of which pbrt's unit is the metre.
struct LensElement {
  float radius = 0;           ///< of curvature, positive where it bulges toward the scene; 0: the stop
  float thickness = 0;        ///< to the next one, of the last one to the film
  float eta = 1;              ///< index of refraction behind it
  float aperture_radius = 0;  ///< light passes within this distance of the axis
};
struct Lenses {
  enum class Stop { circle, gaussian, square, pentagon, star } stop = Stop::circle;  ///< all but the circle have pbrt's shapes
  std::vector<LensElement> elements;  ///< from the scene to the film; focusing moves the film
  float focus_distance = 10;          ///< from the film
  float film_diagonal = 0.035f;
  Location where;
};
struct Camera {
  /// The spherical ones see all around: +y up, to_world and medium count, all else is for the others.
  enum class Kind {
    perspective,
    orthographic,
    spherical_equal_area,       ///< pbrt's square: +y in the middle, -y in the corners, +x to the right, +z to the bottom
    spherical_equirectangular,  ///< +y on top; from +x at the left edge over +z
    realistic,                  ///< through `lenses`, the film's middle at the origin
  } kind = Kind::perspective;
  Transform to_world;                                 ///< camera space: +z forward, +y up
  float fov_degrees = 90;                             ///< of the shorter screen axis
  std::optional<std::array<float, 4>> screen_window;  ///< x0 x1 y0 y1
  std::optional<float> frame_aspect_ratio;
  float lens_radius = 0, focal_distance = 1e6f;
  std::optional<MediumId> medium;
  std::optional<Lenses> lenses;  ///< of a realistic camera
};
struct Film {
  int width = 1280, height = 720;
  PixelBounds crop{0, 0, 1280, 720};
  std::string filename;             ///< as the scene names it; may be empty
  float imaging_ratio = 1;          ///< exposure time * ISO / 100; multiplies the image
  float max_component = kInfinity;  ///< samples are clamped to this; infinity: never
  bool gbuffer = false;
  /// Colour space the image is written in: row-major 3x3 from Rec.709, and its chromaticities.
  std::array<float, 9> from_rec709{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Chromaticities chromaticities;
};
struct PixelFilter {
  enum class Kind { box, triangle, gaussian, mitchell, sinc } kind = Kind::gaussian;
  Vec2 radius{1.5f, 1.5f};
  float sigma = 0.5f;              ///< gaussian
  float b = 1 / 3.f, c = 1 / 3.f;  ///< mitchell
  float tau = 3;                   ///< sinc
};

struct Scene {
  Camera camera;
  Film film;
  PixelFilter filter;
  RenderSettings settings;  ///< from the Integrator and Sampler lines; the command line overrides
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Medium> media;
  std::vector<Boundary> boundaries;
  std::vector<Light> lights;
  std::vector<Shape> shapes;
  std::vector<Object> objects;
  std::vector<Instance> instances;
  std::string source;  ///< the file it came from, or empty
};

}  // namespace tyndall
