// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MeshTopology_h
#define novelview_MeshTopology_h

#include "geometry/TriangleMesh.h"

#include <cstddef>

namespace novelview
{
/**
 * Topology of a triangle mesh, from its connectivity alone.
 *
 * An edge is manifold when exactly two triangles share it, a vertex when its triangles form one
 * closed (or, on a border, one open) fan.
 */
struct MeshTopology
{
  int Points = 0;              ///< points some triangle uses
  int UnusedPoints = 0;        ///< points no triangle uses
  int Edges = 0;               ///< undirected edges
  int Triangles = 0;           ///<
  int BorderEdges = 0;         ///< edges of one triangle
  int NonManifoldEdges = 0;    ///< edges of three triangles or more
  int MisorientedEdges = 0;    ///< edges two triangles run through in the same direction
  int NonManifoldPoints = 0;   ///< points whose triangles form more than one fan
  int DegenerateTriangles = 0; ///< triangles that name a point twice
  int Components = 0;          ///< pieces connected through shared points

  /** Points - edges + triangles; unused points do not count. */
  int EulerCharacteristic() const { return this->Points - this->Edges + this->Triangles; }

  /** Sum of the genera of all components; makes sense for a closed manifold only. */
  int Genus() const { return this->Components - this->EulerCharacteristic() / 2; }

  /** True when every edge has exactly two triangles, which run through it both ways. */
  bool IsClosedAndOriented() const
  {
    return this->Triangles > 0 && this->BorderEdges == 0 && this->NonManifoldEdges == 0 &&
      this->MisorientedEdges == 0 && this->DegenerateTriangles == 0;
  }

  /** True when edges and vertices are manifold. */
  bool IsManifold() const
  {
    return this->NonManifoldEdges == 0 && this->NonManifoldPoints == 0 &&
      this->DegenerateTriangles == 0;
  }
};

/**
 * Examines a mesh.
 *
 * Throws Error when a triangle names a point that does not exist.
 */
MeshTopology ExamineTopology(const TriangleMesh& mesh);

/** What KeepLargestComponent() dropped. */
struct DroppedComponents
{
  int Components = 0;
  std::size_t Triangles = 0;
};

/**
 * Drops all components but the one with the most triangles, and points that it does not use. Of
 * components of one size the one with the smallest point id stays.
 */
DroppedComponents KeepLargestComponent(TriangleMesh& mesh);

/**
 * The volume a closed mesh encloses, in cubic world units: positive when its triangles are
 * counter-clockwise seen from outside.
 */
double SignedVolume(const TriangleMesh& mesh);
}

#endif
