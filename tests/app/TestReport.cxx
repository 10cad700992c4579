// SPDX-License-Identifier: GPL-3.0-or-later
// report.html of a run, opened in a browser, and the meshes a run and `novelview mesh` write.
#include "support/ProgramRun.h"

#include "images/ImageFile.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;
using testing::HasSubstr;

namespace
{
/** A hostile but valid name of a photograph: the page must show it and not run it. */
const char* const HostileName = "a\"onload=\"window.injected=1\"<b>&.png";

/** A small bunny whose data set has such a photograph, and one run on it. */
class Report : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(
      std::vector<std::string>{ "--views", "8", "--step", "45", "--size", "160x120" });
    Rename("bunny0005.png", HostileName);
    MustRun({ "run", Bunny->Data().string(), "--quiet", "--view", Bunny->HeldOut(),
      "--outline-iterations", "2", "--non-outline-iterations", "2", "--out", Out().string(),
      "--mesh-out", (Out() / "mesh/view.glb").string() });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static void Rename(const std::string& from, const std::string& to)
  {
    const fs::path data = Bunny->Data();
    fs::rename(data / from, data / to);
    fs::rename(data / "mask" / from, data / "mask" / to);
    for (const auto& entry : fs::directory_iterator(data))
    {
      std::string text;
      if (entry.path().filename().string().ends_with("_par.txt"))
      {
        text = ReadText(entry.path());
        text.replace(text.find(from), from.size(), to);
        WriteText(entry.path(), text);
      }
    }
  }
  static fs::path Out() { return Bunny->Folder / "run"; }

  static inline std::unique_ptr<GeneratedData> Bunny;
};
}

TEST_F(Report, WorksInABrowser)
{
  const ProcessEnd end = RunShell(std::string(NOVELVIEW_SYSTEM_PYTHON) + " " +
    ShellQuoted(NOVELVIEW_SOURCE_DIR "/tests/app/report_page.py") + " " +
    ShellQuoted((Out() / "report.html").string()) + " " + ShellQuoted(Out().string()));
  if (end.Code == 77)
  {
    GTEST_SKIP() << "chromium, chromium-driver or python3-selenium is not installed";
  }
  EXPECT_EQ(end.Code, 0) << end.Out << end.Err;
}

TEST_F(Report, ShowsNamesAsTheyAre)
{
  const std::string page = ReadText(Out() / "report.html");
  EXPECT_THAT(page, HasSubstr("a&quot;onload=&quot;window.injected=1&quot;&lt;b&gt;&amp;.png"));
  EXPECT_EQ(page.find("\"onload="), std::string::npos);
}

TEST_F(Report, NeedsNothingBesideIt)
{
  const std::string page = ReadText(Out() / "report.html");
  for (const char* foreign :
    { "src=\"http", "href=\"http", "url(", "@import", "<link rel=\"style" })
  {
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  }
  // A page for mail: eight small photographs and six iterations are far from the 10 MB of the full
  // case.
  EXPECT_LT(page.size(), 3u << 20);
}

TEST_F(Report, IsNotWrittenWhereNotWanted)
{
  const fs::path out = Bunny->Folder / "bare";
  MustRun({ "run", Bunny->Data().string(), "--quiet", "--view", Bunny->HeldOut(), "--stage", "hull",
    "--no-depth-maps", "--no-iterations", "--no-report", "--out", out.string() });
  EXPECT_FALSE(fs::exists(out / "report.html"));
  EXPECT_FALSE(fs::exists(out / "rig.png"));
  EXPECT_TRUE(fs::exists(out / "novel.png"));
}

TEST_F(Report, MeshOfTheViewIsWrittenBesideIt)
{
  EXPECT_EQ(ReadText(Out() / "mesh/view.glb").substr(0, 4), "glTF");
  EXPECT_EQ(ReadJson(Out() / "job.json").at("meshOut").at(0), "mesh/view.glb")
    << "the written job names it relative to its own folder";
}

TEST_F(Report, MeshCommandWritesEveryKind)
{
  const fs::path out = Bunny->Folder / "meshes";
  std::vector<std::string> words{ "mesh", Bunny->Data().string(), "--quiet", "--out" };
  for (const char* name : { "m.glb", "m.obj", "m.ply", "m.stl", "m.vtp" })
  {
    words.push_back((out / name).string());
  }
  MustRun(words);
  std::vector<std::string> names;
  for (const auto& [name, content] : FilesBelow(out))
  {
    names.push_back(name);
    EXPECT_FALSE(content.empty()) << name;
  }
  EXPECT_THAT(names,
    testing::UnorderedElementsAre("m.glb", "m.obj", "m.mtl", "m.jpg", "m.ply", "m.stl", "m.vtp"));
}

TEST_F(Report, MeshIsSimplifiedAndTellsWhatItIs)
{
  const fs::path file = Bunny->Folder / "simple.ply";
  const ProcessEnd end =
    RunProgram({ "mesh", Bunny->Data().string(), "--simplify", "2000", "--out", file.string() });
  ASSERT_EQ(end.Code, 0) << end.Err;
  EXPECT_THAT(end.Out, HasSubstr("mesh: simplified from "));
  EXPECT_THAT(end.Out, HasSubstr("mesh: closed manifold of genus "));
  EXPECT_THAT(end.Out, HasSubstr(" pairs of triangles intersect"));
  EXPECT_THAT(ReadText(file), HasSubstr("element face 2000\n"));
}

TEST_F(Report, MeshOfDepthMapsThatAreTooNoisyIsTheCrustAndSaysSo)
{
  const fs::path file = Bunny->Folder / "noisy.ply";
  const ProcessEnd end =
    RunProgram({ "mesh", Bunny->Data().string(), "--depth-noise", "3", "--out", file.string() });
  ASSERT_EQ(end.Code, 0) << end.Err;
  EXPECT_THAT(end.Err, HasSubstr("too much to be fused; the mesh is the power crust of the hull"));
  const fs::path hull = Bunny->Folder / "hull.ply";
  MustRun({ "mesh", Bunny->Data().string(), "--quiet", "--depth-noise", "3", "--stage", "hull",
    "--out", hull.string() });
  EXPECT_TRUE(ReadText(file) == ReadText(hull));
}

TEST_F(Report, MeshFileOfNoKindIsAnErrorBeforeAnyWork)
{
  const fs::path file = Bunny->Folder / "mesh.fbx";
  const ProcessEnd end = RunProgram({ "mesh", Bunny->Data().string(), "--out", file.string() });
  EXPECT_EQ(end.Code, 2);
  EXPECT_THAT(end.Err, HasSubstr("--out: is not a mesh file"));
  EXPECT_THAT(end.Err, HasSubstr(".glb, .obj, .ply, .vtp or .stl"));
  EXPECT_EQ(end.Out, "");
}
