// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SolidTexture_h
#define novelview_SolidTexture_h

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace novelview
{
/** wood, marble, checker, plaster (white, next to no texture) and grey (none at all). */
const std::vector<std::string>& TextureNames();

/** How the surface of a photographed object looks. */
struct SurfaceLook
{
  std::string Texture = "wood"; ///< one of TextureNames()
  bool Lit = true;              ///< shaded by light; otherwise colour alone
  int Seed = 0;                 ///< moves the texture
  /** Strong light that goes with the camera, as the object turns under lamps on a turntable. */
  bool LitFromRig = false;
  double Gloss = 0;    ///< strength of a highlight (Blinn and Phong), 1 = white
  double Exposure = 1; ///< factor of all colours before they are clipped
};

/**
 * An actor with a solid texture: colour is a function of the place in the object, computed for
 * every pixel drawn (GLSL), so no texture coordinates are needed and every view shows the same. The
 * grain scales with the diagonal of the mesh's bounding box.
 *
 * The geometry of the actor is moved so that the centre of the box is the origin (`centre` states
 * by how much), which keeps the precision of single-precision rendering for objects far from the
 * origin; set the actor's position to `centre` to have it back in place. Edges sharper than 50
 * degrees stay sharp in the shading.
 *
 * Throws Error, naming the known ones, when there is no such texture.
 */
vtkSmartPointer<vtkActor> NewTexturedActor(
  vtkPolyData* mesh, const SurfaceLook& look, double centre[3]);

/**
 * Where the camera is, in the coordinates of the mesh: it places highlights and the light of
 * SurfaceLook::LitFromRig, which turns about the y axis with it.
 */
void SetEye(vtkActor* texturedActor, const double eyeFromCentre[3]);

/**
 * Lets a shadow fall on the lower part of the object: `darkness` is the fraction of light taken
 * away, 0 (no shadow, the default) to 1.
 */
void SetShadow(vtkActor* texturedActor, double darkness);
}

#endif
