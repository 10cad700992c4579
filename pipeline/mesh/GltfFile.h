// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_GltfFile_h
#define novelview_GltfFile_h

#include "mesh/Model.h"

#include <string>

namespace novelview
{
/**
 * The model as glTF 2.0 in its binary form (GLB, Khronos 2017), which browsers, game engines and
 * Blender read: one mesh with positions, normals, texture coordinates and the atlas as a JPEG inside.
 *
 * Positions are the data set's, less the middle of their bounding box, in single precision. The
 * node's translation adds the middle, and its rotation takes the model's Up to glTF's +y: the world
 * of the file is the data set's, turned. The unit is the data set's, too; glTF's would be metres.
 *
 * Colours are the photographs' and have their light in them: the material is KHR_materials_unlit,
 * for viewers that do not know it a rough one that is no metal.
 *
 * (vtkGLTFWriter of VTK 9.1 writes no GLB, and textures from files only.) Throws Error when the
 * texture cannot be encoded or the file would be beyond the 4 GiB of the format.
 */
std::string GlbOf(const TexturedModel& model);
}

#endif
