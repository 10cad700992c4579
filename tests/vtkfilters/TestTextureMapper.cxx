// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "support/VtkScene.h"
#include "texture/TextureMapping.h"
#include "vtkViewDependentTextureMapper.h"

#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
struct PlaneCase
{
  std::vector<Photo> Photos =
    TakeAll(Rectangle(0.6, 0.4), Waves(0.4), { OnRing(-20), OnRing(25, 10) });
  vtkSmartPointer<vtkMultiBlockDataSet> Blocks = ToBlocks(Photos);
  TriangleMesh Mesh = RectangleMesh(0.6, 0.4);
  Camera Novel = OnRing(5);

  vtkSmartPointer<vtkViewDependentTextureMapper> Mapper() const
  {
    auto mapper = vtkSmartPointer<vtkViewDependentTextureMapper>::New();
    mapper->SetInputData(0, ToPolyData(this->Mesh));
    mapper->SetInputData(1, this->Blocks);
    mapper->SetCamera(NewPinholeCamera(this->Novel));
    return mapper;
  }
};

const PlaneCase& TheCase()
{
  static const PlaneCase plane;
  return plane;
}

template <class T>
std::vector<T> Values(vtkImageData* image, const char* name, int channels)
{
  const auto rows = TopDownArray<const T>(image, name, channels, "output", true);
  std::vector<T> values;
  for (int y = 0; y < rows.Height; ++y)
  {
    values.insert(values.end(), rows.Row(y), rows.Row(y) + rows.Width * channels);
  }
  return values;
}
}

TEST(TextureMapper, GivesTheKernelsPictureTheRightWayUp)
{
  const PlaneCase& plane = TheCase();
  const auto mapper = plane.Mapper();
  mapper->SetReferences(2);
  mapper->SetPower(3);
  mapper->SetFeatherWidth(1);
  mapper->SetOcclusionSoftness(4);
  mapper->SetFarAngle(1);
  mapper->SetBoundarySamples(2); // raised to 3
  mapper->Update();
  TextureOptions options;
  options.References = 2;
  options.Power = 3;
  options.FeatherPx = 1;
  options.OcclusionPx = 4;
  options.FarDeg = 1;
  options.BoundarySamples = 3;
  const auto expected =
    TextureView(plane.Mesh, nullptr, ViewsOf(plane.Photos), plane.Novel, options);
  vtkImageData* output = mapper->GetOutput();
  EXPECT_EQ(output->GetDimensions()[0], 160);
  EXPECT_EQ(output->GetDimensions()[1], 120);
  EXPECT_EQ(Values<unsigned char>(output, "Color", 3), expected.Color.Values);
  EXPECT_EQ(Values<unsigned char>(output, "Mask", 1), expected.Mask.Values);
  EXPECT_EQ(Values<float>(output, "Depth", 1), expected.Depth.Values);
  EXPECT_EQ(Values<int>(output, "CellId", 1), expected.CellId.Values);
  EXPECT_EQ(Values<unsigned char>(output, "Seen", 1), expected.Seen.Values);
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "Color");
}

TEST(TextureMapper, UsesTheOccludersOfItsThirdPort)
{
  const PlaneCase& plane = TheCase();
  const auto mapper = plane.Mapper();
  const TriangleMesh plate = RectangleMesh(0.25, 0.25, 0.1);
  mapper->SetInputData(2, ToPolyData(plate));
  mapper->Update();
  const auto expected = TextureView(plane.Mesh, &plate, ViewsOf(plane.Photos), plane.Novel);
  EXPECT_EQ(Values<unsigned char>(mapper->GetOutput(), "Color", 3), expected.Color.Values);
  EXPECT_NE(Values<unsigned char>(mapper->GetOutput(), "Seen", 1),
    TextureView(plane.Mesh, nullptr, ViewsOf(plane.Photos), plane.Novel).Seen.Values);
}

TEST(TextureMapper, PhotographsOfDifferentExposureAreBroughtToTheirMean)
{
  // A grey wall of 150, photographed 1.2 and 1.1 times as bright.
  const PlaneCase& plane = TheCase();
  const auto photos =
    std::vector<Photo>{ Take(Rectangle(0.6, 0.4), Plain(180, 180, 180), OnRing(-20), "bright"),
      Take(Rectangle(0.6, 0.4), Plain(165, 165, 165), OnRing(25, 10), "less") };
  const auto plain = ToBlocks(photos);
  const auto blocks = ToBlocks(photos);
  AttachNumber(blocks->GetBlock(0), arrays::ExposureGain, 1.2);
  AttachNumber(blocks->GetBlock(1), arrays::ExposureGain, 1.1);
  const auto picture = [&](vtkMultiBlockDataSet* views, bool useGains)
  {
    const auto mapper = plane.Mapper();
    mapper->SetInputData(1, views);
    mapper->SetUseExposureGains(useGains);
    mapper->Update();
    return Values<unsigned char>(mapper->GetOutput(), "Color", 3);
  };
  const std::size_t middle = 3 * (60 * 160 + 80);
  const auto balanced = picture(blocks, true);
  for (const unsigned char value : balanced)
  {
    EXPECT_TRUE(value == 0 || value == 150) << int(value); // 180 / 1.2 = 165 / 1.1
  }
  EXPECT_EQ(balanced[middle], 150);
  const auto untouched = picture(blocks, false);
  EXPECT_EQ(untouched, picture(plain, false)) << "off: the numbers are not looked at";
  EXPECT_GT(untouched[middle], 165);
  EXPECT_LT(untouched[middle], 180);
  EXPECT_EQ(picture(plain, true), untouched) << "without numbers nothing is to be divided by";
}

TEST(TextureMapper, NoisyDepthMapsHideNothingForGood)
{
  // The map of the first photograph lies two pixels in front of the surface.
  const PlaneCase& plane = TheCase();
  const auto picture = [&](double noise, double softness, bool useDepthMaps)
  {
    const auto blocks = ToBlocks(plane.Photos);
    for (unsigned int viewId = 0; viewId < plane.Photos.size(); ++viewId)
    {
      Image<float> depth = plane.Photos[viewId].TrueDepth;
      for (float& value : depth.Values)
      {
        value -= viewId == 0 && value > 0 ? 0.02f : 0.f;
      }
      CopyToArray(depth, arrays::Depth, vtkImageData::SafeDownCast(blocks->GetBlock(viewId)));
    }
    AttachNumber(blocks, arrays::DepthNoise, noise);
    const auto mapper = plane.Mapper();
    mapper->SetInputData(1, blocks);
    mapper->SetUseDepthMaps(useDepthMaps);
    mapper->SetOcclusionSoftness(softness);
    mapper->Update();
    return Values<unsigned char>(mapper->GetOutput(), "Color", 3);
  };
  EXPECT_EQ(picture(2, 1, true), picture(0, 6, true));
  EXPECT_NE(picture(2, 1, true), picture(0, 1, true));
  EXPECT_EQ(picture(2, 8, true), picture(0, 8, true)) << "softer already";
  EXPECT_EQ(picture(50, 1, true), picture(0, 10, true)) << "never softer than that";
  EXPECT_EQ(picture(2, 0, true), picture(0, 0, true)) << "a hard test stays hard";
  EXPECT_EQ(picture(2, 1, false), picture(0, 1, false)) << "the maps are not used";
}

TEST(TextureMapper, FollowsItsCameraInPlaceAndSize)
{
  const auto mapper = TheCase().Mapper();
  mapper->Update();
  const auto first = Values<unsigned char>(mapper->GetOutput(), "Color", 3);
  Camera other = OnRing(-10);
  other.Width = 100;
  other.Height = 90;
  FromCamera(other, mapper->GetCamera());
  mapper->Update();
  EXPECT_EQ(mapper->GetOutput()->GetDimensions()[0], 100);
  EXPECT_EQ(mapper->GetOutput()->GetDimensions()[1], 90);
  FromCamera(TheCase().Novel, mapper->GetCamera());
  mapper->Update();
  EXPECT_EQ(Values<unsigned char>(mapper->GetOutput(), "Color", 3), first);
}

TEST(TextureMapper, OneOrTwoThreadsGiveTheSamePicture)
{
  const auto mapper = TheCase().Mapper();
  SetNumberOfThreads(1);
  mapper->Update();
  const auto first = Values<unsigned char>(mapper->GetOutput(), "Color", 3);
  SetNumberOfThreads(2);
  mapper->Modified();
  mapper->Update();
  EXPECT_EQ(Values<unsigned char>(mapper->GetOutput(), "Color", 3), first);
  SetNumberOfThreads(0);
}

TEST(TextureMapper, SaysWhatIsWrong)
{
  const auto mapper = TheCase().Mapper();
  mapper->SetCamera(nullptr);
  ExpectUpdateError(mapper, "novel camera: none is set");
  Camera noSize = TheCase().Novel;
  noSize.Width = 0;
  mapper->SetCamera(NewPinholeCamera(noSize));
  ExpectUpdateError(mapper, "novel camera: image size is not positive (got 0x120");
  mapper->SetCamera(NewPinholeCamera(TheCase().Novel));
  const auto blocks = ToBlocks(TheCase().Photos);
  vtkImageData::SafeDownCast(blocks->GetBlock(1))->GetPointData()->RemoveArray("Color");
  mapper->SetInputData(1, blocks);
  ExpectUpdateError(mapper, "view 1 (p1): point array Color is missing");
  mapper->SetInputData(1, TheCase().Blocks);
  mapper->Update();
  EXPECT_EQ(mapper->GetOutput()->GetNumberOfPoints(), 160 * 120) << "and recovers";
}

TEST(TextureMapper, AnEmptyMeshIsABlackPicture)
{
  const auto mapper = TheCase().Mapper();
  mapper->SetInputData(0, ToPolyData({}));
  mapper->Update();
  EXPECT_THAT(Values<unsigned char>(mapper->GetOutput(), "Mask", 1), testing::Each(0));
}

TEST(TextureMapper, PrintsEveryMember)
{
  ExpectPrints(TheCase().Mapper(),
    { "Camera", "References", "Power", "FeatherWidth", "OcclusionSoftness", "FarAngle",
      "UseDepthMaps", "UseExposureGains", "BoundarySamples" });
}
