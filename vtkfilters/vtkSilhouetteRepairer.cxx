// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkSilhouetteRepairer.h"

#include "FilterSupport.h"
#include "silhouettes/ContourDistance.h"
#include "silhouettes/SilhouetteRepair.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkSilhouetteRepairer);

//------------------------------------------------------------------------------
vtkSilhouetteRepairer::vtkSilhouetteRepairer()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
int vtkSilhouetteRepairer::FillInputPortInformation(int port, vtkInformation* info)
{
  novelview::SetInputType(info, port, 0);
  return 1;
}

namespace
{
/** Replaces the silhouette of an image by its union with a part; returns the pixels added. */
int Add(
  const novelview::Image<std::uint8_t>& part, const novelview::View& view, vtkImageData* image)
{
  novelview::Image<float> distance = novelview::SignedContourDistance(part.Ref());
  novelview::Image<std::uint8_t> mask(part.Width, part.Height);
  int added = 0;
  for (int y = 0; y < part.Height; ++y)
  {
    for (int x = 0; x < part.Width; ++x)
    {
      added += part(x, y) > 0;
      distance(x, y) = std::max(distance(x, y), view.ContourDistance(x, y));
      mask(x, y) = part(x, y) > 0 ? 255 : view.Mask(x, y);
    }
  }
  novelview::CopyToArray(distance, novelview::arrays::ContourDistance, image);
  novelview::CopyToArray(mask, novelview::arrays::Mask, image);
  return added;
}
}

//------------------------------------------------------------------------------
int vtkSilhouetteRepairer::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Repaired = false;
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
      const std::vector<novelview::View> views = novelview::ReadColouredViews(input);
      const novelview::MissingParts parts = novelview::FindMissingParts(views,
        novelview::ToTriangleMesh(vtkPolyData::GetData(inputs[1]), "hull"), {},
        novelview::ExecutionFor(this));
      vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
      for (unsigned int viewId = 0; viewId < views.size(); ++viewId)
      {
        vtkNew<vtkImageData> image;
        image->ShallowCopy(novelview::ViewImage(input, viewId));
        const int added =
          parts[viewId].Values.empty() ? 0 : Add(parts[viewId], views[viewId], image);
        this->Repaired = this->Repaired || added > 0;
        novelview::AttachNumber(image, novelview::arrays::AddedPixels, added);
        novelview::AppendView(output, views[viewId].Name, image, views[viewId].Cam);
      }
    });
}

//------------------------------------------------------------------------------
void vtkSilhouetteRepairer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Repaired: " << (this->Repaired ? "yes" : "no") << "\n";
}
