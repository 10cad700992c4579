// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ObjectMesh_h
#define novelview_ObjectMesh_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace novelview
{
/**
 * The built-in objects, all closed: "bunny" (the Stanford bunny of Debian's glmark2-data), "part"
 * (a block with flat faces, sharp edges and a through hole), "stool" (thin legs), "lattice" (thin struts
 * behind each other), "bust" (a smooth head with concavities), "torus".
 */
const std::vector<std::string>& BuiltinObjects();

/** "bunny" for the built-in object or "/a/b/horse.obj" -> "horse". */
std::string ObjectName(const std::string& mesh);

/**
 * The object in a mesh as a file contains it (see MeshFile.h): triangles only, equal points merged,
 * neighbouring faces turned the same way, and outwards when the mesh is closed; coordinates as they
 * were, rounded to float. No arrays. Throws Error, with `where`, when that leaves no triangle.
 */
vtkSmartPointer<vtkPolyData> MakeObject(vtkPolyData* raw, const std::string& where);

/**
 * The object to be photographed: a built-in one by its name (empty = "bunny"), or a mesh file (ply,
 * obj, stl, vtp), as MakeObject() makes it.
 *
 * Throws Error when the file is missing, unreadable, malformed or of another kind, and when it
 * contains no triangle whose corners are at three places.
 */
vtkSmartPointer<vtkPolyData> LoadObject(const std::string& mesh);
}

#endif
