// SPDX-License-Identifier: GPL-3.0-or-later
/** The sizes of photographs: as they are, as others are, and small enough for the memory. */
#ifndef novelview_PhotographSize_h
#define novelview_PhotographSize_h

#include "cameras/Photograph.h"
#include "dataset/Dataset.h"

#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/** A photograph's camera with its size, which is opened only when its calibration does not say it. */
Camera SizedCamera(const Photograph& photograph);

/**
 * A photograph's camera for a frame of another size: K scaled where the shapes are alike (within 1 %),
 * the principal point as far from the middle of the frame where portrait and landscape are. Throws
 * Error where neither is so; `with` names what the frame is taken from.
 */
Camera InFrame(const Photograph& photograph, int width, int height, const std::string& with);

/**
 * A photograph that was resized after its calibration would carve the object away. It shows where
 * another photograph has the same K: throws Error. Cameras need their sizes.
 */
void RequireOneSizePerK(const std::vector<Photograph>& cameras);

/** Reduces a photograph whose longer side is above `maxSize` pixels; 0 = leaves it. */
void Reduce(Photograph& photograph, int maxSize);

/** About what `run` needs for photographs with their sizes, bytes. */
double MemoryFor(const std::vector<Camera>& cameras);

/**
 * Reduces the photographs of a data set, except those that are excluded, whose longer side is above
 * `maxSize` (0 = none); without a value, so far that DefaultMemory suffices. A note says so. Another
 * note warns when the memory that is free does not suffice.
 *
 * Opens photographs only when their calibration does not say their size.
 */
constexpr double DefaultMemory = 4.0 * (1 << 30); ///< bytes
void LimitSize(DatasetIndex& index, const std::vector<std::string>& exclude,
  const std::optional<double>& maxSize);
}

#endif
