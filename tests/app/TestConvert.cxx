// SPDX-License-Identifier: GPL-3.0-or-later
// `novelview convert`, by the built program: the stages see the same in every format.
#include "support/ProgramRun.h"

#include "dataset/Dataset.h"
#include "formats/DatasetFormats.h"
#include "images/ImageFile.h"

#include <cmath>

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;
using testing::HasSubstr;

namespace
{
/** A small bunny for all tests here; a view takes about a second. */
class ConvertProgram : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(
      std::vector<std::string>{ "--views", "8", "--step", "45", "--size", "160x120" });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static std::string Data() { return Bunny->Data().string(); }
  static fs::path In(const std::string& name) { return Bunny->Folder / name; }

  /** The novel view of a data set, between two cameras by their numbers. */
  static fs::path View(
    const std::string& data, const std::string& out, const std::vector<std::string>& more = {})
  {
    MustRun(With({ "run", data, "--quiet", "--view", "between:1,2", "--no-iterations", "--out",
                   In(out).string() },
      more));
    return In(out);
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
};

/** Expects the same bits: the last bits in which formats differ have no influence. */
void ExpectSameView(const fs::path& a, const fs::path& b)
{
  const Image<std::uint8_t> pictureA = ReadColorFile(a / "novel.png");
  const Image<std::uint8_t> pictureB = ReadColorFile(b / "novel.png");
  EXPECT_TRUE(pictureA.Values == pictureB.Values) << a << " and " << b;
}
}

TEST_F(ConvertProgram, ThroughColmapTheNovelViewIsTheSame)
{
  MustRun({ "convert", Data(), In("colmap").string(), "--format", "colmap", "--quiet" });
  EXPECT_TRUE(HalfWritten(In("colmap")).empty());
  ExpectSameView(View(Data(), "direct"), View(In("colmap").string(), "through"));
}

TEST_F(ConvertProgram, AJobRemembersHowTheDataSetIsToBeRead)
{
  // OpenCV's cameras in a file that is said to be NeRF's: only the options make it right.
  MustRun({ "convert", Data(), In("nerf").string(), "--format", "nerf", "--quiet" });
  auto transforms = ReadJson(In("nerf") / "transforms.json");
  for (auto& frame : transforms["frames"])
  {
    for (int row = 0; row < 3; ++row)
    {
      for (int column : { 1, 2 })
      {
        frame["transform_matrix"][row][column] =
          -frame["transform_matrix"][row][column].get<double>();
      }
    }
  }
  WriteText(In("nerf") / "transforms.json", transforms.dump());
  const fs::path made =
    View(In("nerf").string(), "axes", { "--axes", "opencv", "--format", "nerf" });
  ExpectSameView(View(Data(), "plain"), made);
  const auto job = ReadJson(made / "job.json");
  EXPECT_EQ(job["axes"], "opencv");
  EXPECT_EQ(job["format"], "nerf");
  EXPECT_EQ(job["poses"], "format");
  EXPECT_TRUE(job["pixelCentre"].is_null());
  MustRun({ "run", (made / "job.json").string(), "--quiet", "--out", In("again").string() });
  EXPECT_EQ(ReadText(In("again") / "novel.png"), ReadText(made / "novel.png"));
}

TEST_F(ConvertProgram, BadUseIsOneLineWithAnExitCode)
{
  const auto expect = [](const std::vector<std::string>& words, int code, const std::string& part)
  {
    const ProcessEnd end = RunProgram(With({ "convert" }, words));
    EXPECT_EQ(end.Code, code);
    EXPECT_THAT(end.Err, HasSubstr(part));
    EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), 1) << end.Err;
  };
  const std::string out = In("bad").string();
  expect({ Data() }, 2, "out is required");
  expect({ Data(), out }, 2, "--format: no format to write given");
  expect(
    { Data(), out, "--format", "agisoft" }, 2, "--format: is not a valid choice (got 'agisoft'");
  expect({ Data(), Data(), "--format", "nerf" }, 2, "is the folder to read");
  expect({ Data(), out, "--format", "nerf", "--from", "colmap" }, 1, "no calibration file");
  expect(
    { Data(), out, "--format", "nerf", "--poses", "camera" }, 2, "--poses: is not a valid choice");
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(ConvertProgram, ACameraThatIsOffByTwoPixelsIsNamedAndItsPoseWrittenRefined)
{
  const GeneratedData bunny({ "--size", "480x360" });
  DatasetIndex index = ReadDatasetIndex(bunny.Data());
  const Camera truth = index.Cameras[5].Cam;
  Camera& turned = index.Cameras[5].Cam;
  turned.R = Eigen::AngleAxisd(2 / truth.FocalLength(), Eigen::Vector3d(0.6, 0.8, 0)) * truth.R;
  turned.T = -turned.R * truth.Centre();
  for (const FileContent& file : FormatOf("middlebury").Compose("bunny", index.Cameras))
  {
    WriteText(bunny.Data() / file.Path, file.Bytes);
  }
  const ProcessEnd off = RunProgram({ "check", bunny.Data().string() });
  EXPECT_EQ(off.Code, 3);
  EXPECT_THAT(off.Out, HasSubstr("bunny0005.png: the camera is about"));
  const fs::path refined = bunny.Folder / "refined";
  const ProcessEnd convert = RunProgram({ "convert", bunny.Data().string(), refined.string(),
    "--format", "middlebury", "--refine-cameras" });
  EXPECT_EQ(convert.Code, 0) << convert.Err;
  EXPECT_THAT(convert.Out + convert.Err, HasSubstr("cameras refined: photographs disagreed by"));
  const Camera written = ReadDatasetIndex(refined).Cameras[5].Cam;
  const Eigen::Vector3d target = Eigen::Vector3d::Zero();
  EXPECT_LT((written.Project(target) - truth.Project(target)).norm(), 0.5);
  EXPECT_THAT(RunProgram({ "check", refined.string() }).Out, Not(HasSubstr("the camera is about")));
}
