/// Names of the attributes by which an image tells how it was made. What is not said to be otherwise is text.
#pragma once

namespace tyndall::attributes {

// Of every render.
inline constexpr const char* kSoftware = "software";              ///< Tyndall and its version
inline constexpr const char* kScene = "tyndall/scene";            ///< the file
inline constexpr const char* kSceneHash = "tyndall/sceneHash";    ///< World::scene_hash
inline constexpr const char* kSamples = "tyndall/samples";        ///< a pixel: an int, or "32..512" where pixels differ
inline constexpr const char* kSeed = "tyndall/seed";              ///< of several renders "1, 2"
inline constexpr const char* kOptions = "tyndall/options";        ///< every option that chooses a method, with its value
inline constexpr const char* kRenderTime = "tyndall/renderTime";  ///< seconds, a double; not of a reproducible one
inline constexpr const char* kDate = "tyndall/date";              ///< UTC, "2026-01-31T12:00:00Z"; not of a reproducible one

// Of those that have them.
/// What else than samples may have ended the render, as options: "--time 60 --error 0.01".
inline constexpr const char* kEnd = "tyndall/end";
inline constexpr const char* kStopped = "tyndall/stopped";          ///< the int 1: before its end
inline constexpr const char* kLightGroups = "tyndall/lightGroups";  ///< "key,sky,default", in the order of their sums in slices
inline constexpr const char* kMatteNames = "tyndall/matteNames";    ///< with mattes: a hash of all names of the scene
inline constexpr const char* kDeepBins = "tyndall/deepBins";        ///< an int: of the deep image that was rendered along
inline constexpr const char* kSharing = "tyndall/sharing";          ///< an int: how many pixels share their noise at most

// Of a slice of a render.
inline constexpr const char* kSlice = "tyndall/slice";           ///< "3/16 of 1024 samples 128..192", and more words
inline constexpr const char* kAovs = "tyndall/aov";              ///< those asked for: "Albedo,Z"
inline constexpr const char* kFilmSpace = "tyndall/fromRec709";  ///< the film's colour matrix: 9 floats, and zeros after them
inline constexpr const char* kDeepLayout = "tyndall/deep";       ///< where there is a deep image: the bins of its sums
inline constexpr const char* kSumHash = "tyndall/sumHash";       ///< of the channels "Sum.*"
inline constexpr const char* kCommand = "tyndall/command";       ///< the command that rendered it

// Of what was made of renders.
inline constexpr const char* kSlices = "tyndall/slices";      ///< "seed 1 samples 3 crop 0,8,0,6; ...": what was merged
inline constexpr const char* kRelight = "tyndall/relight";    ///< by which factors light groups were mixed anew
inline constexpr const char* kDenoised = "tyndall/denoised";  ///< what was filtered, and which AOVs were missing
inline constexpr const char* kRuns = "tyndall/runs";          ///< an int: renders of which a reference is the mean
inline constexpr const char* kSamplesPerRun = "tyndall/samplesPerRun";  ///< an int: a pixel, of each of these

}  // namespace tyndall::attributes
