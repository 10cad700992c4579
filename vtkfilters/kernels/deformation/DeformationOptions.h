// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of the deformers. Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_DeformationOptions_h
#define novelview_DeformationOptions_h

#include "core/Parameter.h"

namespace novelview
{
/** Of all deformers: iterations, at most. */
inline constexpr Parameter<int> IterationsParameter{ 10, 0, 1000 };

struct MembraneOptions
{
  int Sweeps = 8;     ///< how many rings of neighbours follow
  double Decay = 0.9; ///< of the following, from ring to ring
};

/** Of DeformOutline(). */
struct OutlineOptions
{
  /** Weight of the contour energy. */
  static constexpr Parameter<double> AlphaParameter{ 0.3, 0, 100 };
  double Alpha = AlphaParameter.Default;
  /** Weight of the smoothness energy. */
  static constexpr Parameter<double> BetaParameter{ 0.3, 0, 100 };
  double Beta = BetaParameter.Default;
  /** At most; 0 only measures. */
  int Iterations = IterationsParameter.Default;

  // ---- the search
  /** How far to either side candidates lie, novel pixels. */
  static constexpr Parameter<double> SearchPxParameter{ 4, 0.25, 50, "px" };
  double SearchPx = SearchPxParameter.Default;
  double StepPx = 0.5;        ///< spacing of the candidates, novel pixels
  double MaxMovePx = 1.5;     ///< how far a point goes in the first iteration, novel pixels
  double MoveDecay = 0.8;     ///< of MaxMovePx from iteration to iteration
  double ConvergencePx = 0.1; ///< stop when no point moves further

  // ---- the terms
  /** Of the photo-consistency windows, input pixels. */
  static constexpr Parameter<int> WindowRadiusParameter{ 3, 1, 7, "px" };
  int WindowRadius = WindowRadiusParameter.Default;
  int Secondaries = 2;     ///< the key's neighbours, at most
  double MinFacing = 0.4;  ///< a view that is compared lies so far on the moving side, cosine
  double MaxApartDeg = 62; ///< and a secondary no further from the key
  double BehindPx = 3;     ///< and the model hides the point by no more, input pixel footprints
  /** Sigma of the contour energy, input pixels. */
  static constexpr Parameter<double> SigmaPxParameter{ 4, 0.5, 100, "px" };
  double SigmaPx = SigmaPxParameter.Default;
  int NearViews = 2;        ///< views of the contour energy, at most
  double NearAngleDeg = 45; ///< and no further from the novel view than this

  // ---- when a minimum counts
  double MinVariance = 60;    ///< of the key window, grey levels squared; flatter ones say nothing
  double Margin = 0.05;       ///< the energy must fall by more
  double MaxPhoto = 0.2;      ///< E_s there is no more,
  double MaxPhotoShare = 0.5; ///< nor more than this part of what it is where the point is
  double Rise = 0.05;         ///< and the energy rises by more to both sides,
  double RisePx = 6;          ///< within this, novel pixels

  MembraneOptions Membrane;
};

/** Of DeformNonOutline(). */
struct NonOutlineOptions
{
  /** Weight of the smoothness energy. */
  static constexpr Parameter<double> AlphaParameter{ 0.3, 0, 100 };
  double Alpha = AlphaParameter.Default;
  /** At most; 0 only measures. */
  int Iterations = IterationsParameter.Default;
  /** How far from a point candidates lie, pixel footprints. */
  static constexpr Parameter<double> SearchPxParameter{ 12, 0.25, 100, "pixel footprints" };
  double SearchPx = SearchPxParameter.Default;
  double StepPx = 0.25;       ///< spacing of the candidates, pixel footprints
  double ConvergencePx = 0.1; ///< stop when no point moves further
  /** Of the matching windows, input pixels. */
  static constexpr Parameter<int> WindowRadiusParameter{ 5, 1, 7, "px" };
  int WindowRadius = WindowRadiusParameter.Default;
  int Secondaries = 2; ///< the key's neighbours
  /** Search range along the epipolar line, each way, input pixels. */
  static constexpr Parameter<int> MatchRangePxParameter{ 24, 0, 64, "px" };
  int MatchRangePx = MatchRangePxParameter.Default;
  double RangeDecay = 0.85; ///< of that range from iteration to iteration,
  int MinRangePx = 8;       ///< down to this, input pixels
  int MatchStridePx = 2;    ///< first every so many pixels, then all about the best
  int MatchAcrossPx = 1;    ///< and, about the best there, across it (calibration error)
  int NormalRounds = 2;     ///< of smoothing the normals that choose the keys
};
}

#endif
