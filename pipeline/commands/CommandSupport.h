// SPDX-License-Identifier: GPL-3.0-or-later
/** What the commands on a data set (run, render, evaluate) have in common. */
#ifndef novelview_CommandSupport_h
#define novelview_CommandSupport_h

#include "base/Console.h"
#include "dataset/Dataset.h"
#include "dataset/DatasetInput.h"
#include "synthesis/Synthesis.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/**
 * Makes the out folder, proves that it can be written, and announces the files that go into it, all
 * before any work is done. Throws Error when one of them would replace what the run reads.
 */
void PrepareFolder(
  const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

/** The calibration of the photographs, which are reduced as the input says. */
DatasetIndex FindInput(const DatasetInput& input);

/** Prints what reading the calibration ignored, guessed or changed; ReadInput() does, too. */
void WarnOf(const DatasetIndex& index, Console& console);

/** Reads the photographs, except those that are excluded or held out, and prints the warnings. */
Dataset ReadInput(const DatasetInput& input, const DatasetIndex& index,
  const std::vector<std::string>& heldOut, Console& console);

/** A listener that reports everything except the iterations to the console. */
SynthesisListener ListenerFor(Console& console);

/**
 * The image a novel view is compared with, arrays Color and Mask; undistorted, and without a mask
 * the silhouette is taken from the picture. Throws Error when it is not of the camera's size.
 */
vtkSmartPointer<vtkImageData> ReadTruth(
  const Photograph& truth, const SilhouetteOptions& silhouette, const Camera& camera);
}

#endif
