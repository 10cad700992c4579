// SPDX-License-Identifier: GPL-3.0-or-later
/** Which views of a data set do not belong to the others, and why. */
#ifndef novelview_OutlierSearch_h
#define novelview_OutlierSearch_h

#include "check/AgreementSurvey.h"
#include "check/CheckReport.h"
#include "check/CheckedSilhouettes.h"
#include "core/Execution.h"

#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/** A view that does not belong to the others. */
struct OutlierView
{
  int CameraId = 0;
  std::string Kind; ///< "swapped", "mask-inverted", "mask-of-another", "mask", "camera" or "view"
  std::string Text;
};

/**
 * Leaves out, one after the other, the views without which all others agree (at most a third of
 * them), takes back those that agree with the rest after all, and looks for what mends each: its mask
 * inverted, that of another, or the silhouette that its photograph shows.
 */
class OutlierSearch
{
public:
  OutlierSearch(const std::vector<Photograph>& cameras, CheckedSilhouettes& silhouettes,
    const std::vector<FoundMask>& masks, const SilhouetteOptions& silhouette,
    const Execution& execution);

  /** Does it; fills in one entry per camera. */
  void Examine(std::vector<CheckedCamera>& agreement);

  const std::vector<OutlierView>& Outliers() const { return this->Found; }
  /** Their names, with commas. */
  std::string OutlierNames() const;
  double MeanIou() const { return this->First.MeanIou; }
  /** The same without the outlier ones. */
  double MeanIouAfter() const { return this->Last.MeanIou; }
  const std::vector<Eigen::Vector3d>& HullPoints() const { return this->Last.Points; }

private:
  AgreementSurvey Survey(const std::vector<int>& ids) const;
  static std::optional<std::size_t> Suspect(const AgreementSurvey& survey);
  void LeaveOut();
  void Reinstate();
  bool AgreesWithRest(const std::vector<int>& more) const;
  bool AgreesWith(int id, const FoundMask& mask, bool invert);
  Image<std::uint8_t> Seen(int id) const;
  void Explain();
  void ExplainSwaps();
  OutlierView ExplainOne(int id);
  OutlierView ExplainByPhotograph(int id);
  std::string DescribeExclusivelyCarved(int id) const;

  const std::vector<Photograph>& Cameras;
  CheckedSilhouettes& Silhouettes;
  const std::vector<FoundMask>& Masks;
  const SilhouetteOptions& Extraction;
  const Execution& Run;
  std::vector<int> Active;               ///< ids of the views that are not outlier
  std::vector<int> Out;                  ///< ids of those that are
  std::vector<double> ExclusivelyCarved; ///< by camera, when it was outlier
  AgreementSurvey First;                 ///< of all
  AgreementSurvey Last;                  ///< of Active
  std::vector<OutlierView> Found;
};
}

#endif
