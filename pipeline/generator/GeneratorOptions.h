// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_GeneratorOptions_h
#define novelview_GeneratorOptions_h

#include "options/Options.h"

#include <string>
#include <vector>

namespace novelview
{
/** What is photographed, from where, and how imperfectly. View ids count from 0. */
struct GeneratorOptions
{
  // ---- object
  std::string Mesh; ///< a built-in object's name, or a ply, obj, stl or vtp file; "" = bunny
  std::string Texture = "wood"; ///< wood, marble, checker, plaster or grey
  bool Lit = true;              ///< false = colours alone
  /** "world": mild, fixed to the object; "rig": strong, goes with the cameras (a turntable). */
  std::string Light = "world";
  double Gloss = 0;    ///< strength of the highlights; 1 = white
  double Exposure = 1; ///< factor of all brightness; what becomes brighter than white is clipped
  int Seed = 0;        ///< moves the texture and draws the noise

  // ---- rig: cameras on a circle around the vertical (y) axis, looking at the object's centre
  int Views = 12;
  double StepDeg = 30;        ///< angle between neighbouring cameras, degrees
  double ElevationDeg = 0;    ///< height of the cameras above the horizon, degrees
  double SecondRingDeg = 0;   ///< every second camera is so much higher, degrees
  int Width = 640;            ///< pixels
  int Height = 480;           ///< pixels
  double FieldOfViewDeg = 30; ///< vertical, degrees
  double Fill = 0.75;         ///< share of the frame that the object's larger extent takes
  int Supersampling = 4;      ///< samples per pixel and axis
  std::vector<double> TestAnglesDeg = { 15 }; ///< held-out views, degrees on the same circle

  // ---- imperfections; all off by default, none ever in the held-out views
  double GainSpread = 0;           ///< each view's brightness is multiplied by 1 +- up to this
  double NoiseSigma = 0;           ///< of every pixel and channel, grey levels
  double CalibrationNoisePx = 0;   ///< written rotations are off by about this many pixels,
  double PrincipalNoisePx = 0;     ///< written principal points as well,
  double FocalNoise = 0;           ///< and written focal lengths by about this share
  double DefocusPx = 0;            ///< sigma of a blur, pixels
  double Vignetting = 0;           ///< share of the brightness that is missing in the corners
  int JpegQuality = 0;             ///< compressed as a JPEG of this quality; 0 = not
  int MaskErodePx = 0;             ///< masks shrunk by this many pixels; negative: grown
  std::vector<int> MaskErodeViews; ///< which masks; empty = all
  double FrameShift = 0; ///< object's centre off the frame's, as a share of the frame's width
  std::vector<int> FrameShiftViews; ///< in which photographs; empty = every third
  std::vector<int> ShadowViews;     ///< photographs in which a shadow lies on the object
  double ShadowDarkness = 0.96;     ///< share of the light that it takes away
  /**
   * "exact", "threshold" (every pixel brighter than 24 of 255: what simple thresholding makes of
   * the photograph, so that shadowed parts are missing) or "none".
   */
  std::string Masks = "exact";
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(GeneratorOptions& options);

/**
 * Throws Error when an option is out of the range that its table states, or names a view that there
 * is not. Files are not checked.
 */
void ValidateGeneratorOptions(const GeneratorOptions& options);
}

#endif
