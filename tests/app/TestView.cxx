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

TEST(View, OpensTheBrowserByAFileThatOnlyTheUserCanRead)
{
  const GeneratedData bunny({ "--views", "8", "--step", "45", "--size", "160x120" });
  const std::string folder = (bunny.Folder / "").string();
  WriteText(bunny.Folder / "xdg-open",
    "#!/bin/sh\nstat -c '%a' \"$1\" > '" + folder + "mode'\ncp \"$1\" '" + folder +
      "part' && mv '" + folder + "part' '" + folder + "opened'\n");
  const ProcessEnd end = RunShell("cd " + ShellQuoted(folder) +
    " && chmod +x xdg-open && export PATH=.:$PATH DISPLAY=:9 XDG_RUNTIME_DIR=$PWD && (" +
    ShellQuoted(NOVELVIEW_PROGRAM) +
    " view data > log 2>&1 & program=$!; while kill -0 $program && [ ! -e opened ]; do sleep 0.1; "
    "done; kill -INT $program; wait $program; ls novelview-*.html)");
  EXPECT_THAT(ReadText(bunny.Folder / "opened"), testing::HasSubstr("url=http://127.0.0.1:"));
  EXPECT_EQ(ReadText(bunny.Folder / "mode"), "600\n");
  EXPECT_THAT(end.Out, testing::Not(testing::HasSubstr("novelview-"))) << "the file is left behind";
}
