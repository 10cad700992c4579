// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/AtomicFile.h"
#include "support/Stop.h"
#include "support/TestSupport.h"

#include <csignal>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

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

TEST(AtomicFile, LeftoversOfKilledRunsAreRemovedAndThoseInUseAreNot)
{
  const TemporaryFolder folder;
  WriteText(folder / ".novelview-tmp.1234.0.png", "half a picture");
  const fs::path used = folder / ".novelview-tmp.1234.1.png";
  WriteText(used, "of a run that goes on");
  const int lock = ::open(used.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  WriteTextAtomically(folder / "a.txt", "whole");
  EXPECT_FALSE(fs::exists(folder / ".novelview-tmp.1234.0.png"));
  EXPECT_TRUE(fs::exists(used));
  ::close(lock);
}

TEST(AtomicFile, AFullDiskLeavesTheOldFileAndNamesIt)
{
  const TemporaryFolder folder;
  WriteText(folder / "a.txt", "old");
  // As on a full disk: not even the first byte can be written.
  struct rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit none = before;
  none.rlim_cur = 0;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
  std::string message;
  try
  {
    WriteTextAtomically(folder / "a.txt", "new");
  }
  catch (const Error& error)
  {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, testing::HasSubstr("a.txt: cannot be written: File too large"));
  EXPECT_EQ(ReadText(folder / "a.txt"), "old");
  const auto entries = fs::directory_iterator(folder.Path);
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << "a.txt alone";
}
