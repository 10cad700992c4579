// SPDX-License-Identifier: GPL-3.0-or-later
/** What was found out about a data set. */
#ifndef novelview_CheckReport_h
#define novelview_CheckReport_h

#include "cameras/Photograph.h"
#include "check/CheckedPhotograph.h"
#include "check/ConventionTrials.h"
#include "check/PixelCentres.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
enum class CheckSeverity
{
  Note,    ///< worth knowing
  Warning, ///< results suffer
  Error    ///< the data set cannot be used like this
};

/** One thing that was found. */
struct CheckFinding
{
  CheckSeverity Severity = CheckSeverity::Note;
  std::string Kind;                 ///< a word for programs, see README
  std::string View;                 ///< photograph; empty = the whole data set
  std::string Text;                 ///< one sentence
  std::vector<std::string> Options; ///< of the command line that mend it; empty = none do
  std::string Command;              ///< one that applies them; empty = none
};

/** A camera in the comparison of the silhouettes. */
struct CheckedCamera
{
  bool TakesPart = false;         ///< it has a silhouette
  bool Outlier = false;           ///< its silhouette does not belong to the others
  double Iou = 0;                 ///< of its silhouette and the hull of all, see AgreementSurvey
  std::optional<double> IouAfter; ///< the same without the outlier ones
  double ExclusivelyCarved = 0;   ///< part of the others' contour rays that it alone rules out
};

struct CheckReport
{
  std::filesystem::path Folder;
  std::filesystem::path Calibration;
  std::string Format;
  std::vector<CheckedPhotograph> Photographs; ///< one per camera
  std::vector<Photograph> Cameras;            ///< read in the convention that was found right
  std::vector<CheckedCamera> Agreement;       ///< one per camera
  double MeanIou = 0;                         ///< of those that take part
  std::optional<double> MeanIouAfter;         ///< of those that are not outlier, when some are
  std::vector<ConventionTrial> Trials;        ///< the first is how the calibration is read
  int ChosenTrial = 0;
  bool MasksInverted = false; ///< the masks are the other way round than they were read
  std::optional<PixelCentreVerdict>
    PixelCentre;                           ///< shifts 0, the other centre, twice that, minus that
  std::vector<Eigen::Vector3d> HullPoints; ///< some points on the hull
  std::vector<CheckFinding> Findings;      ///< errors first

  bool HasProblems() const; ///< whether there is anything but notes
};

/** "error", "warning", "note" */
const char* SeverityName(CheckSeverity severity);
}

#endif
