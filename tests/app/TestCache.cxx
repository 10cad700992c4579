// SPDX-License-Identifier: GPL-3.0-or-later
// `--cache`, by the built program: whatever happens to the folder, the picture is right.
#include "support/ProgramRun.h"

#include <unistd.h>

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;
using testing::HasSubstr;

namespace
{
class CacheFolder : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(
      std::vector<std::string>{ "--views", "8", "--step", "45", "--size", "96x72" });
    fs::permissions(Bunny->Folder.Path, fs::perms(0755));
    MustRun(Words(Out("right"), {}));
    Right = ReadText(Out("right") / "novel.png");
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static fs::path Out(const std::string& name) { return Bunny->Folder / name; }

  /** The words that make one picture. */
  static std::vector<std::string> Words(const fs::path& out, const std::vector<std::string>& more)
  {
    return With({ "run", Bunny->Data().string(), "--view", "between:0,1", "--quiet", "--no-report",
                  "--no-iterations", "--out", out.string() },
      more);
  }

  /** Runs with the cache; `before` is what the shell does first, `as` what starts the program. */
  ProcessEnd Run(const std::string& before = "", const std::string& as = "") const
  {
    std::string command = before + "\n" + as + " " + ShellQuoted(NOVELVIEW_PROGRAM);
    for (const std::string& word :
      Words(this->Place / "out", { "--cache", (this->Place / "cache").string() }))
    {
      command += " " + ShellQuoted(word);
    }
    return RunShell(command);
  }

  /** Expects the right picture and one warning with this part, or none when it is empty. */
  void ExpectRight(const ProcessEnd& end, const std::string& part) const
  {
    EXPECT_EQ(end.Code, 0);
    EXPECT_TRUE(ReadText(this->Place / "out" / "novel.png") == Right);
    EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), part.empty() ? 0 : 1) << end.Err;
    EXPECT_THAT(end.Err, HasSubstr(part));
    EXPECT_THAT(end.Err, testing::StartsWith(part.empty() ? "" : "novelview: warning: cache: "));
  }

  fs::path OnlyEntry() const
  {
    const auto files = FilesBelow(this->Place / "cache");
    EXPECT_EQ(files.size(), 1u);
    return this->Place / "cache" / files.begin()->first;
  }

  void Damage(std::size_t at, char byte) const
  {
    std::string bytes = ReadText(this->OnlyEntry());
    bytes.at(at) = byte == bytes.at(at) ? ~byte : byte;
    WriteText(this->OnlyEntry(), bytes);
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
  static inline std::string Right;
  const TemporaryFolder Place;
};
}

TEST_F(CacheFolder, IsNotPoisonedByAShortWrite)
{
  // A disk that is full once the results are written: no file may be larger than the largest result.
  std::size_t largest = 0;
  for (const auto& [name, bytes] : FilesBelow(Out("right")))
  {
    largest = std::max(largest, bytes.size());
  }
  const std::size_t limitKiB = largest / 1024 + 8;
  this->ExpectRight(
    this->Run("ulimit -f " + std::to_string(2 * limitKiB) + " || exit 9"), "nothing is kept");
  EXPECT_TRUE(FilesBelow(this->Place / "cache").empty());
  this->ExpectRight(this->Run(), "");
  EXPECT_GT(fs::file_size(this->OnlyEntry()), limitKiB * 1024) << "or the limit says nothing";
  this->ExpectRight(this->Run(), "");
}

TEST_F(CacheFolder, ADamagedByteIsOneWarningAndMended)
{
  // cache-manifest-unchecked, cache-manifest-utf8, cache-stale-warning: in the directory and behind.
  this->ExpectRight(this->Run(), "");
  const std::string good = ReadText(this->OnlyEntry());
  for (const std::size_t at :
    { std::size_t{ 0 }, std::size_t{ 40 }, good.size() / 2, good.size() - 1 })
  {
    this->Damage(at, '\264');
    this->ExpectRight(this->Run(), "computed again");
    EXPECT_TRUE(ReadText(this->OnlyEntry()) == good) << at;
    this->ExpectRight(this->Run(), "");
  }
}

TEST_F(CacheFolder, WithoutPermissionIsOneWarning)
{
  fs::permissions(this->Place.Path, fs::perms(0777));
  fs::create_directory(this->Place / "cache");
  fs::permissions(this->Place / "cache", fs::perms::none);
  const std::string nobody = "setpriv --reuid=65534 --regid=65534 --clear-groups";
  const std::string as = ::geteuid() == 0 ? nobody : "";
  if (RunShell(as + " test -x " + ShellQuoted(NOVELVIEW_PROGRAM)).Code != 0)
  {
    GTEST_SKIP() << "root may read everything, and nobody may not run the program";
  }
  this->ExpectRight(this->Run("", as), "Permission denied");
  fs::permissions(this->Place / "cache", fs::perms(0555));
  this->ExpectRight(this->Run("", as), "nothing is kept");
  fs::permissions(this->Place / "cache", fs::perms(0777));
  this->ExpectRight(this->Run("", as), "");
  fs::permissions(this->OnlyEntry(), fs::perms::none);
  this->ExpectRight(this->Run("", as), "Permission denied");
  this->ExpectRight(this->Run("", as), "");
}

TEST_F(CacheFolder, AFileInItsPlaceStays)
{
  WriteText(this->Place / "cache", "of the user");
  this->ExpectRight(this->Run(), "nothing is kept");
  EXPECT_EQ(ReadText(this->Place / "cache"), "of the user");
}
