// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_IterationSection_h
#define novelview_IterationSection_h

#include "report/ReportPage.h"
#include "report/RunReport.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace novelview
{
/** "NAME, RMS 12.34"; the name alone without scores. */
std::string WithRms(const std::string& name, const std::optional<Scores>& scores);

/**
 * Section "Iterations" of the page of a run: a player of at most 60 iterations, evenly chosen, with
 * their images in `folder`; charts of scores and energies; tables.
 */
void AddIterations(ReportPage& page, const RunReport& report, const std::filesystem::path& folder);

/** The rows of a step, Outline or Full (= non-outline): scores, mean energies, points moved. */
nlohmann::ordered_json IterationsJson(const RunReport& report, Stage step);
}

#endif
