// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's images: how far a novel view is from the truth, in colours.
#ifndef novelview_ErrorPicture_h
#define novelview_ErrorPicture_h

#include <vtkColorTransferFunction.h>
#include <vtkImageData.h>
#include <vtkSmartPointer.h>

namespace novelview
{
/** Black, violet, red, orange, yellow: dark = small, and readable in grey as well. */
vtkSmartPointer<vtkColorTransferFunction> HeatColours(double most);

/**
 * Mean absolute difference of the channels in the foreground (either mask), coloured, as the array
 * Color. Without masks the whole frame is foreground. Throws Error when the sizes differ.
 */
vtkSmartPointer<vtkImageData> ErrorPicture(
  vtkImageData* novel, vtkImageData* truth, vtkScalarsToColors* table);
}

#endif
