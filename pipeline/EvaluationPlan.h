// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EvaluationPlan_h
#define novelview_EvaluationPlan_h

#include "Job.h"
#include "ViewSpec.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
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
 * Looks the views up that the options ask for. Test views are the lines of the one *_par.txt in
 * DATASET/test whose photographs lie beside it. Throws UsageError when a name is unknown or no
 * reference is left.
 */
EvaluationPlan MakeEvaluationPlan(const EvaluateOptions& options, const DatasetIndex& dataset);
}

#endif
