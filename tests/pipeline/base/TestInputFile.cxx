// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/InputFile.h"

#include "base/AtomicFile.h"
#include "support/TestSupport.h"

#include <sys/stat.h>

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

namespace
{
class InputFile : public testing::Test
{
protected:
  void SetUp() override { WriteText(this->Photograph, "a photograph"); }

  /** Whatever path leads to the photograph, it is refused and stays. */
  void ExpectKept(const fs::path& output)
  {
    ExpectError([&] { AnnounceOutput(output); }, output.filename().string(), "reads it");
    ExpectError(
      [&] { WriteTextAtomically(output, "new"); }, output.filename().string(), "reads it");
    EXPECT_EQ(ReadText(this->Photograph), "a photograph");
  }

  const TemporaryFolder Folder;
  const fs::path Photograph = this->Folder / "a.png";
  const InputProtection Protection;
};
}

TEST_F(InputFile, WhatWasReadIsNotReplaced)
{
  EXPECT_EQ(ReadInputFile(this->Photograph), "a photograph");
  this->ExpectKept(this->Photograph);
  this->ExpectKept(this->Folder / "new/../a.png");
}

TEST_F(InputFile, WhatIsOnlyNamedIsNotReplaced)
{
  ProtectInput(this->Photograph);
  ProtectInput(this->Folder / "none.png");
  this->ExpectKept(this->Photograph);
  WriteTextAtomically(this->Folder / "none.png", "new");
}

TEST_F(InputFile, LinksAreTheFileItself)
{
  ProtectInput(this->Photograph);
  fs::create_hard_link(this->Photograph, this->Folder / "hard.png");
  fs::create_symlink("a.png", this->Folder / "soft.png");
  fs::create_directory_symlink(".", this->Folder / "folder");
  this->ExpectKept(this->Folder / "hard.png");
  this->ExpectKept(this->Folder / "soft.png");
  this->ExpectKept(this->Folder / "folder/a.png");
}

TEST_F(InputFile, AnnouncedFirstAndReadLaterIsRefusedToo)
{
  AnnounceOutput(this->Photograph);
  ExpectError([&] { ReadInputFile(this->Photograph); }, "a.png", "would be replaced");
  ExpectError([&] { ProtectInput(this->Photograph); }, "a.png", "would be replaced");
}

TEST_F(InputFile, TwoResultsOfOneNameAreRefused)
{
  AnnounceOutput(this->Folder / "b.png");
  ExpectError([&] { AnnounceOutput(this->Folder / "x/../b.png"); }, "b.png", "twice");
}

TEST_F(InputFile, OwnResultsMayBeReadAndWrittenAgain)
{
  AnnounceOutput(this->Photograph);
  WriteTextAtomically(this->Photograph, "first");
  EXPECT_EQ(ReadInputFile(this->Photograph), "first");
  WriteTextAtomically(this->Photograph, "second");
  EXPECT_EQ(ReadText(this->Photograph), "second");
}

TEST_F(InputFile, SameBytesAreNoReplacement)
{
  ProtectInput(this->Photograph);
  AnnounceText(this->Photograph, "a photograph");
  WriteTextAtomically(this->Photograph, "a photograph");
  ExpectError([&] { AnnounceText(this->Photograph, "another"); }, "reads it");
}

TEST_F(InputFile, ReplacingMayBeAllowed)
{
  ProtectInput(this->Photograph);
  AllowReplacing(this->Photograph);
  WriteTextAtomically(this->Photograph, "new");
  EXPECT_EQ(ReadText(this->Photograph), "new");
}

TEST_F(InputFile, PipesAndDevicesAndFoldersAreNoInput)
{
  const fs::path pipe = this->Folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ExpectError([&] { ReadInputFile(pipe); }, "pipe", "is not a regular file");
  ExpectError([&] { ReadInputStart(pipe, 4); }, "pipe", "is not a regular file");
  ExpectError([&] { ReadInputFile("/dev/zero"); }, "/dev/zero", "a device");
  ExpectError([&] { ReadInputFile(this->Folder.Path); }, "a folder");
  ExpectError([&] { ReadInputFile(this->Folder / "none"); }, "none", "no such file");
}

TEST_F(InputFile, PipesAndDevicesAndFoldersAreNotReplaced)
{
  ExpectError([&] { WriteTextAtomically("/dev/null", "x"); }, "/dev/null", "a device");
  ExpectError([&] { AnnounceOutput(this->Folder.Path); }, "a folder");
}

TEST_F(InputFile, TheStartAloneCanBeRead)
{
  EXPECT_EQ(ReadInputStart(this->Photograph, 3), "a p");
  EXPECT_EQ(ReadInputStart(this->Photograph, 300), "a photograph");
  const std::string large(300000, 'x');
  WriteText(this->Folder / "large", large);
  EXPECT_EQ(ReadInputFile(this->Folder / "large"), large);
  EXPECT_FALSE(ReadInputFile("/proc/self/status").empty()) << "a file that tells no size";
}

TEST(InputFileUnprotected, OtherProgramsMayReplaceWhatTheyRead)
{
  const TemporaryFolder folder;
  WriteText(folder / "a.txt", "old");
  EXPECT_EQ(ReadInputFile(folder / "a.txt"), "old");
  WriteTextAtomically(folder / "a.txt", "new");
  EXPECT_EQ(ReadText(folder / "a.txt"), "new");
}
