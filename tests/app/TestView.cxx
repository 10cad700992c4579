// SPDX-License-Identifier: GPL-3.0-or-later
// `novelview view`, by the built program and a browser.
#include "support/ProgramRun.h"

using namespace novelview;
using namespace novelview::testing_support;

TEST(View, DraggedInABrowserItShowsWhatRenderMakes)
{
  const GeneratedData bunny({ "--views", "8", "--step", "45", "--size", "160x120" });
  const ProcessEnd end = RunShell(std::string(NOVELVIEW_SYSTEM_PYTHON) + " " +
    ShellQuoted(NOVELVIEW_SOURCE_DIR "/tests/app/view_page.py") + " " +
    ShellQuoted(NOVELVIEW_PROGRAM) + " " + ShellQuoted(bunny.Data().string()) + " " +
    ShellQuoted((bunny.Folder / "").string()));
  if (end.Code == 77)
  {
    GTEST_SKIP() << "chromium, chromium-driver or python3-selenium is not installed";
  }
  EXPECT_EQ(end.Code, 0) << end.Out << end.Err;
}
