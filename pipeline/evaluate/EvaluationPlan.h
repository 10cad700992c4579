// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EvaluationPlan_h
#define novelview_EvaluationPlan_h

#include "dataset/ViewSpec.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/**
 * Which photographs are predicted. At most one of the three ways to hold photographs out is chosen;
 * with none the data set's own test views are predicted or, when it has none, each photograph in turn.
 */
struct HoldOutOptions
{
  std::vector<std::string> HoldOut; ///< photographs left out and predicted, all at once
  int Every = 0;                    ///< the same for photographs 0, K, 2K ..; 0 = not
  bool LeaveOneOut = false;         ///< each photograph is predicted from all others
  std::filesystem::path TrueMesh;   ///< for the oracle; empty = the test views' truth.ply, if any
};

/** A view to predict; its truth is always known. */
struct PlannedView
{
  std::string Name;
  ResolvedView View;
};

/** Views that are predicted from the same references. */
struct PlannedSet
{
  std::vector<PlannedView> Views;
  std::vector<std::string> HeldOut; ///< photographs that are no references
  std::size_t References = 0;       ///< how many photographs are
};

/** What an evaluation predicts, and from what. */
struct EvaluationPlan
{
  std::string Mode; ///< "test views", "hold out", "one photograph of every K", "leave one out"
  std::vector<PlannedSet> Sets;
  std::filesystem::path TrueMesh; ///< empty = none known
  std::vector<std::string> Warnings;
};

/**
 * Looks the views up that the options ask for; photographs in `exclude` are left out. Test views are
 * the lines of the one *_par.txt in DATASET/test whose photographs lie beside it, or those of NeRF's
 * transforms_test.json or else transforms_val.json. Throws UsageError when a name is unknown or no
 * reference is left.
 */
EvaluationPlan MakeEvaluationPlan(const HoldOutOptions& options, const DatasetIndex& dataset,
  const std::vector<std::string>& exclude = {});
}

#endif
