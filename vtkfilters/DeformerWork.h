// SPDX-License-Identifier: GPL-3.0-or-later
// What a deformer works on; for the .cxx files of deformers.
#ifndef novelview_DeformerWork_h
#define novelview_DeformerWork_h

#include "core/Execution.h"
#include "deformation/Deformation.h"
#include "geometry/Camera.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "vtkViewDeformer.h"

#include <cstdint>
#include <vector>

class vtkDataObject;

struct vtkViewDeformer::Work
{
  novelview::Camera Camera;
  novelview::TriangleMesh Mesh;
  std::vector<novelview::View> Views;
  std::vector<std::uint8_t> Visible; ///< per point
  std::vector<std::uint8_t> Outline; ///< per point
  vtkDataObject* ViewData;           ///< that the views were read from
  novelview::DeformationListener Listener;
  novelview::Execution Execution;
};

#endif
