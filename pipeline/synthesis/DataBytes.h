// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_DataBytes_h
#define novelview_DataBytes_h

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <string_view>

namespace novelview
{
/**
 * VTK's data as bytes and back, for the cache: points, cells and all numeric arrays, each
 * compressed by LZ4. What is unpacked has the same bits. Unpacking is safe for any bytes: it throws
 * Error when lengths, types or point ids do not fit, and allocates no more than the bytes can
 * contain.
 *
 * @param where names the bytes in errors.
 */
std::string PackedMesh(vtkPolyData* mesh);
vtkSmartPointer<vtkPolyData> UnpackedMesh(std::string_view bytes, const std::string& where);

std::string PackedImage(vtkImageData* image);
vtkSmartPointer<vtkImageData> UnpackedImage(std::string_view bytes, const std::string& where);
}

#endif
