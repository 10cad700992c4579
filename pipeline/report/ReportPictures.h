// SPDX-License-Identifier: GPL-3.0-or-later
/** Pictures for the pages of the reports. */
#ifndef novelview_ReportPictures_h
#define novelview_ReportPictures_h

#include "report/ReportPage.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace novelview
{
/** Every photograph, small, with its silhouette's contour drawn in; captions are their names. */
std::vector<ReportPicture> PhotographPictures(vtkMultiBlockDataSet* views);

/** The photographs as images of at most this size, without masks. */
std::vector<vtkSmartPointer<vtkImageData>> SmallPhotographs(
  vtkMultiBlockDataSet* views, int longestSidePx);

/** The array Color of an image; with `blackened`, black outside its Mask. */
ReportPicture EmbedImage(const std::string& name, const std::string& caption, vtkImageData* image,
  int longestSidePx, bool blackened = false);
}

#endif
