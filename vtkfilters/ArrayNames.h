// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * The names of all arrays that filters read and write. ViewAccess.h and the headers of the filters
 * describe their contents.
 */
#ifndef novelview_ArrayNames_h
#define novelview_ArrayNames_h

namespace novelview::arrays
{
// ---- of views and images
inline constexpr const char* Color = "Color";
inline constexpr const char* Mask = "Mask";
inline constexpr const char* ContourDistance = "ContourDistance";
inline constexpr const char* Depth = "Depth";
inline constexpr const char* Confidence = "Confidence";
inline constexpr const char* CellId = "CellId";
inline constexpr const char* Seen = "Seen";
inline constexpr const char* CameraMatrix = "CameraMatrix";
inline constexpr const char* Rotation = "Rotation";
inline constexpr const char* Translation = "Translation";
inline constexpr const char* ExposureGain = "ExposureGain";
inline constexpr const char* ContourOffset = "ContourOffset";
inline constexpr const char* AddedPixels = "AddedPixels";
inline constexpr const char* CameraShift = "CameraShift";
// ---- of all views together
inline constexpr const char* DepthNoise = "DepthNoise";
inline constexpr const char* SilhouettePrior = "SilhouettePrior";
inline constexpr const char* SilhouetteSupport = "SilhouetteSupport";
// ---- of meshes
inline constexpr const char* Normals = "Normals";
inline constexpr const char* TCoords = "TCoords";
inline constexpr const char* Radius = "Radius";
inline constexpr const char* SampleIds = "SampleIds";
inline constexpr const char* OriginalPointIds = "OriginalPointIds";
inline constexpr const char* Visible = "Visible";
inline constexpr const char* OutlineFlag = "OutlineFlag";
inline constexpr const char* Displacement = "Displacement";
inline constexpr const char* Energy = "Energy";
inline constexpr const char* EnergyPhoto = "EnergyPhoto";
inline constexpr const char* EnergyContour = "EnergyContour";
inline constexpr const char* EnergyHull = "EnergyHull";
inline constexpr const char* EnergySmooth = "EnergySmooth";
}

#endif
