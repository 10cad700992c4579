// SPDX-License-Identifier: GPL-3.0-or-later
#include "AtomicFile.h"
#include "TestSupport.h"
#include "support/Stop.h"

using namespace novelview;
using namespace novelview::testing_support;
using support::Stop;
namespace fs = std::filesystem;

TEST(AtomicFile, AStopIsHeardBeforeAnythingIsWritten)
{
  const TemporaryFolder folder;
  WriteTextAtomically(folder / "a.txt", "before");
  Stop stop;
  stop.Flag = true;
  EXPECT_THROW(WriteTextAtomically(folder / "a.txt", "after"), Interrupted);
  EXPECT_THROW(WriteTextAtomically(folder / "new/b.txt", "after"), Interrupted);
  EXPECT_EQ(ReadText(folder / "a.txt"), "before");
  EXPECT_FALSE(fs::exists(folder / "new")) << "not even the folder is made";
  stop.Flag = false;
  WriteTextAtomically(folder / "new/b.txt", "after");
  EXPECT_EQ(ReadText(folder / "new/b.txt"), "after") << "and then it can be written again";
}

TEST(AtomicFile, AFileThatIsBeingWrittenIsFinishedFirst)
{
  const TemporaryFolder folder;
  Stop stop;
  WriteAtomically(folder / "a.txt",
    [&](const fs::path& temporary)
    {
      stop.Flag = true; // as a signal handler would
      WriteText(temporary, "whole");
      return true;
    });
  EXPECT_EQ(ReadText(folder / "a.txt"), "whole");
  EXPECT_THROW(WriteTextAtomically(folder / "b.txt", ""), Interrupted) << "the next is not begun";
  const auto entries = fs::directory_iterator(folder.Path);
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << "a.txt alone";
}
