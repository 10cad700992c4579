// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkReferenceDepthEstimator.h"

#include "FilterSupport.h"
#include "deformation/TsdfDeformation.h"
#include "fusion/SilhouettePrior.h"
#include "fusion/SilhouetteSupport.h"
#include "geometry/ViewSelection.h"
#include "stereo/MapComparison.h"
#include "stereo/ReferenceDepth.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>

vtkStandardNewMacro(vtkReferenceDepthEstimator);

//------------------------------------------------------------------------------
vtkReferenceDepthEstimator::vtkReferenceDepthEstimator()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
int vtkReferenceDepthEstimator::FillInputPortInformation(int port, vtkInformation* info)
{
  novelview::SetInputType(info, port, 0);
  return 1;
}

namespace
{
/** Comparisons of the maps: noise, prior of the outline, exposures. */
void AttachComparisons(vtkMultiBlockDataSet* output, const novelview::TriangleMesh& hull,
  const novelview::Execution& execution)
{
  const std::vector<novelview::View> views = novelview::ReadColouredViews(output, 2);
  const double footprint = novelview::MedianFootprint(views, hull.Points);
  if (footprint <= 0)
  {
    return; // no maps, nothing to compare
  }
  const double noise = novelview::DepthNoise(views, footprint, execution);
  novelview::SilhouettePriorOptions prior;
  prior.Fusion = novelview::OptionsForNoise(noise).Outline;
  prior.Noise = noise;
  novelview::AttachNumber(output, novelview::arrays::DepthNoise, noise);
  novelview::FusionOptions outline = prior.Fusion;
  outline.SilhouettePrior = novelview::FindSilhouettePrior(views, hull, prior, execution);
  novelview::AttachNumber(output, novelview::arrays::SilhouettePrior, outline.SilhouettePrior);
  novelview::AttachSupport(output,
    novelview::FindSilhouetteSupport(
      views, novelview::TsdfField(views, outline, footprint), hull, footprint, {}, execution));
  std::vector<double> gains = novelview::ExposureGains(views, footprint, execution);
  if (!novelview::GainsPredictBetter(views, gains, footprint, execution))
  {
    gains.assign(gains.size(), 1);
  }
  for (unsigned int viewId = 0; viewId < views.size(); ++viewId)
  {
    novelview::AttachNumber(
      novelview::ViewImage(output, viewId), novelview::arrays::ExposureGain, gains[viewId]);
  }
}
}

//------------------------------------------------------------------------------
int vtkReferenceDepthEstimator::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
      const std::vector<novelview::View> views = novelview::ReadColouredViews(input, 2);
      const novelview::TriangleMesh hull =
        novelview::ToTriangleMesh(vtkPolyData::GetData(inputs[1]), "hull");

      auto depths = novelview::EstimateReferenceDepths(
        views, hull, this->Options, novelview::ExecutionFor(this));

      vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
      for (unsigned int viewId = 0; viewId < views.size(); ++viewId)
      {
        vtkNew<vtkImageData> image;
        image->ShallowCopy(novelview::ViewImage(input, viewId));
        novelview::CopyToArray(depths[viewId].Depth, novelview::arrays::Depth, image);
        novelview::CopyToArray(depths[viewId].Confidence, novelview::arrays::Confidence, image);
        novelview::AppendView(output, views[viewId].Name, image, views[viewId].Cam);
        depths[viewId] = {}; // large photographs, and many of them, should not be held twice
      }
      AttachComparisons(output, hull, novelview::ExecutionFor(this));
    });
}

//------------------------------------------------------------------------------
void vtkReferenceDepthEstimator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
}
