// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SceneGeometry_h
#define novelview_SceneGeometry_h

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

namespace novelview
{
/** What the stages make of the photographs for every novel camera alike. */
struct SceneGeometry
{
  vtkSmartPointer<vtkPolyData> Hull; ///< points with normals
  vtkSmartPointer<vtkPolyData> Crust;
  vtkSmartPointer<vtkPolyData> MedialBalls;
  vtkSmartPointer<vtkMultiBlockDataSet>
    Views;                           ///< the photographs as deformers and mapper want them
  std::vector<std::string> Warnings; ///< warnings of the stages
};

/** A named part of a scene as bytes. */
struct SceneSection
{
  std::string Name;
  std::string Bytes;
};

/**
 * A scene as bytes, a section for each mesh (none for one that is null) and each view; for the cache
 * and for other processes. The views' sections hold their arrays and field data; with `given`, only
 * those that the views of `given`, which the reader has as well, do not have. Numbers are in this
 * machine's byte order.
 */
std::vector<SceneSection> PackScene(
  const SceneGeometry& scene, vtkMultiBlockDataSet* given = nullptr);

/** Where a scene is read from; `Read` may be called from several threads and throws Error. */
struct SceneSource
{
  std::vector<std::string> Names; ///< of the sections
  std::function<std::string(const std::string& name)> Read;
  std::function<std::string(const std::string& name)> Where; ///< names a section in errors
};

/**
 * The scene, whose bits are those of the one that was packed. `given` must be as it was then. Safe for
 * any bytes. Throws Error.
 */
SceneGeometry UnpackScene(const SceneSource& source, vtkMultiBlockDataSet* given = nullptr);
}

#endif
