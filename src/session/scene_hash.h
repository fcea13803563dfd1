/// One number for what decides the right picture of a scene.
#pragma once

#include <cstdint>
#include <string>

#include "tyndall/scene.h"

namespace tyndall {

class KeptFiles;  // tyndall/frames.h

/// Hash of everything in `scene` that the expected picture depends on, and of the content of the files it names. Left
/// out: the settings (how to render; scene_hash_text adds the depth), crop and output name, names of things, places in
/// the scene file, and paths, so that a scene that was moved is still the same scene. Throws Error (scene) when a file
/// cannot be read.
std::uint64_t hash_scene(const Scene& scene, KeptFiles* kept = nullptr);

/// Hash of the names that mattes go by, which hash_scene leaves out.
std::uint64_t hash_names(const Scene& scene);

/// The scene with what the settings say about the right picture, as 16 hexadecimal digits: World::scene_hash.
std::string scene_hash_text(std::uint64_t scene_hash, const RenderSettings& settings);

}  // namespace tyndall
