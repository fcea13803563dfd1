/// What an image says of itself when it holds but a range of a render's samples (tyndall/slice.h).
#pragma once

#include "session/film_buffer.h"
#include "tyndall/settings.h"

namespace tyndall {

/// The AOVs that a film gathers: those asked for, Variance in a slice, and SampleCount where it differs.
std::vector<Aov> film_aovs(const RenderSettings& settings);

/// "3/16 of 1024", or "whole".
std::string slice_text(const RenderSettings& settings);

/// Add the exact sums and what SliceSum needs to make an image of them; `samples` have been done.
void add_slice(Image& image, const FilmBuffer& film, const RenderSettings& settings, int samples);

/// A slice that was stopped says so; other images are left as they are.
void mark_stopped(Image& image);

}  // namespace tyndall
