// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/OffscreenWindow.h"

#include "support/MessageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cstdlib>

namespace
{
using novelview::MessageOf;
using novelview::OffscreenWindow;

/** A renderer that shows nothing but its background. */
vtkSmartPointer<vtkRenderer> Plain(double red, double green, double blue)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(red, green, blue);
  return renderer;
}

double Value(vtkImageData* image, int x, int y, int channel)
{
  return image->GetScalarComponentAsDouble(x, y, 0, channel);
}

TEST(OffscreenWindow, DrawsWithoutADisplay)
{
  ::unsetenv("DISPLAY");
  OffscreenWindow window(64, 48);
  EXPECT_THAT(window.RendererName(), testing::HasSubstr("OpenGL"));
  window.Window()->AddRenderer(Plain(1, 0, 0.2));
  vtkSmartPointer<vtkImageData> image = window.Capture();
  ASSERT_EQ(image->GetPointData()->GetScalars()->GetNumberOfComponents(), 3);
  EXPECT_EQ(Value(image, 63, 47, 0), 255);
  EXPECT_EQ(Value(image, 63, 47, 1), 0);
  EXPECT_EQ(Value(image, 63, 47, 2), 51); // 0.2 * 255
}

TEST(OffscreenWindow, IgnoresADisplayThatIsSet)
{
  ::setenv("DISPLAY", ":987", 1); // nobody listens there: any try to connect would fail
  EXPECT_EQ(Value(novelview::RenderOffscreen(Plain(0, 1, 0), 9, 7), 8, 6, 1), 255);
  ::unsetenv("DISPLAY");
}

TEST(OffscreenWindow, DrawsAnySizeOneAfterTheOther)
{
  for (const auto& [width, height] :
    { std::pair(1, 1), std::pair(2000, 3), std::pair(33, 1501), std::pair(640, 480) })
  {
    vtkSmartPointer<vtkImageData> image = novelview::RenderOffscreen(Plain(0, 0, 1), width, height);
    ASSERT_EQ(image->GetDimensions()[0], width);
    ASSERT_EQ(image->GetDimensions()[1], height);
    EXPECT_EQ(Value(image, width - 1, height - 1, 2), 255);
  }
}

TEST(OffscreenWindow, SeveralWindowsKeepTheirOwnPictures)
{
  OffscreenWindow first(40, 30);
  OffscreenWindow second(20, 50);
  first.Window()->AddRenderer(Plain(1, 0, 0));
  second.Window()->AddRenderer(Plain(0, 1, 0));
  for (int round = 0; round < 2; ++round)
  {
    EXPECT_EQ(Value(first.Capture(), 39, 29, 0), 255);
    EXPECT_EQ(Value(second.Capture(), 19, 49, 1), 255);
  }
  {
    OffscreenWindow third(10, 10);
    third.Window()->AddRenderer(Plain(0, 0, 1));
    EXPECT_EQ(Value(third.Capture(), 9, 9, 2), 255);
  }
  EXPECT_EQ(Value(first.Capture(), 0, 0, 0), 255);
}

TEST(OffscreenWindow, AlphaTellsObjectFromBackground)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0, 0, 0); // black on black: only alpha tells
  auto renderer = Plain(0, 0, 0);
  renderer->AddActor(actor);
  OffscreenWindow window(61, 61);
  window.Window()->AddRenderer(renderer);
  renderer->ResetCamera();
  vtkSmartPointer<vtkImageData> image = window.Capture(true);
  EXPECT_EQ(Value(image, 30, 30, 3), 255);
  EXPECT_EQ(Value(image, 0, 0, 3), 0);
}

TEST(OffscreenWindow, RefusesImpossibleSizes)
{
  EXPECT_THAT(MessageOf([] { OffscreenWindow(0, 10); }),
    testing::HasSubstr("picture size is not positive (got 0x10"));
  EXPECT_THAT(MessageOf([] { OffscreenWindow(10, 1000000); }),
    testing::HasSubstr("larger than the driver can do (got 10x1000000"));
}
}
