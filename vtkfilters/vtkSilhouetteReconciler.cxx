// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSilhouetteReconciler.h"

#include "FilterSupport.h"
#include "silhouettes/SilhouetteConsistency.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkSilhouetteReconciler);

namespace
{
/** Replaces the silhouette of an image by one that reaches `offset` pixels further. */
void Enlarge(const novelview::View& view, double offset, vtkImageData* image)
{
  novelview::Image<float> distance(view.Cam.Width, view.Cam.Height);
  novelview::Image<std::uint8_t> mask(view.Cam.Width, view.Cam.Height);
  for (int y = 0; y < distance.Height; ++y)
  {
    for (int x = 0; x < distance.Width; ++x)
    {
      distance(x, y) = view.ContourDistance(x, y) + static_cast<float>(offset);
      mask(x, y) = distance(x, y) > 0 ? 255 : 0;
    }
  }
  novelview::CopyToArray(distance, novelview::arrays::ContourDistance, image);
  novelview::CopyToArray(mask, novelview::arrays::Mask, image);
}
}

//------------------------------------------------------------------------------
int vtkSilhouetteReconciler::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
      novelview::ViewNeeds needs;
      needs.ContourDistance = true;
      const std::vector<novelview::View> views = novelview::ReadViews(input, needs);
      const std::vector<double> offsets =
        novelview::FindContourOffsets(views, this->Options, novelview::ExecutionFor(this));
      vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
      for (unsigned int viewId = 0; viewId < views.size(); ++viewId)
      {
        vtkNew<vtkImageData> image;
        image->ShallowCopy(novelview::ViewImage(input, viewId));
        if (offsets[viewId] > 0)
        {
          Enlarge(views[viewId], offsets[viewId], image);
        }
        novelview::AttachNumber(image, novelview::arrays::ContourOffset, offsets[viewId]);
        novelview::AppendView(output, views[viewId].Name, image, views[viewId].Cam);
      }
    });
}

//------------------------------------------------------------------------------
void vtkSilhouetteReconciler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
}
