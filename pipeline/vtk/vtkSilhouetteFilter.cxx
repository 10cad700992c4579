// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSilhouetteFilter.h"

#include "FilterSupport.h"
#include "base/Parallel.h"
#include "masks/Coverage.h"
#include "masks/Silhouette.h"
#include "silhouettes/ContourDistance.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

vtkStandardNewMacro(vtkSilhouetteFilter);

namespace
{
/** A view on its way through the filter. */
struct Completed
{
  vtkSmartPointer<vtkImageData> Image;
  std::vector<std::string> Warnings;
};

Completed Complete(
  const novelview::View& view, vtkImageData* input, const std::string& where, bool force)
{
  Completed result;
  result.Image = vtkSmartPointer<vtkImageData>::New();
  result.Image->ShallowCopy(input);
  if (view.Mask.Empty() || force)
  {
    if (view.Color.Empty())
    {
      throw novelview::Error(where, "there is neither a point array Mask nor Color");
    }
    novelview::CopyToArray(
      novelview::ExtractSilhouette(view.Color), novelview::arrays::Mask, result.Image);
  }
  const auto mask = novelview::TopDownArray<const unsigned char>(
    result.Image, novelview::arrays::Mask, 1, where, true);
  result.Warnings = novelview::CheckCoverage(novelview::MeasureCoverage(mask), where);
  if (view.ContourDistance.Empty() || force)
  {
    novelview::CopyToArray(
      novelview::SignedContourDistance(mask), novelview::arrays::ContourDistance, result.Image);
  }
  return result;
}
}

//------------------------------------------------------------------------------
int vtkSilhouetteFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
      novelview::ViewNeeds needs;
      needs.Mask = false;
      const std::vector<novelview::View> views = novelview::ReadViews(input, needs);
      std::vector<Completed> completed(views.size());
      novelview::ParallelForEach(views.size(),
        [&](std::size_t viewId)
        {
          completed[viewId] =
            Complete(views[viewId], novelview::ViewImage(input, static_cast<unsigned int>(viewId)),
              "view " + views[viewId].Name, this->Force);
        });
      vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
      for (std::size_t viewId = 0; viewId < views.size(); ++viewId)
      {
        for (const std::string& warning : completed[viewId].Warnings)
        {
          vtkWarningMacro(<< warning);
        }
        novelview::AppendView(
          output, views[viewId].Name, completed[viewId].Image, views[viewId].Cam);
      }
    });
}

//------------------------------------------------------------------------------
void vtkSilhouetteFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Force: " << this->Force << "\n";
}
