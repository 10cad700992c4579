// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/Canvas.h"

#include "Threads.h"
#include "ViewAccess.h"
#include "core/PrintableText.h"

#include <vtkCamera.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageMapper3D.h>
#include <vtkImageProperty.h>
#include <vtkImageResize.h>
#include <vtkPointData.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace novelview
{
namespace
{
/** The largest box with the sides' ratio of width : height in the middle of another box. */
Box Fitted(const Box& box, int width, int height)
{
  const double scale =
    std::min(static_cast<double>(box.Width) / width, static_cast<double>(box.Height) / height);
  Box fitted;
  fitted.Width = std::max(1, static_cast<int>(std::lround(scale * width)));
  fitted.Height = std::max(1, static_cast<int>(std::lround(scale * height)));
  fitted.X = box.X + (box.Width - fitted.Width) / 2;
  fitted.Y = box.Y + (box.Height - fitted.Height) / 2;
  return fitted;
}

/** A copy that holds nothing but the array Color, as its scalars. */
vtkSmartPointer<vtkImageData> ColorAlone(vtkImageData* picture)
{
  auto alone = vtkSmartPointer<vtkImageData>::New();
  alone->SetDimensions(picture->GetDimensions());
  alone->GetPointData()->SetScalars(picture->GetPointData()->GetArray(arrays::Color));
  return alone;
}
}

//------------------------------------------------------------------------------
Canvas::Canvas(
  int width, int height, const Colour& background, std::shared_ptr<OffscreenWindow> window)
  : Width(width)
  , Height(height)
  , Window(window ? std::move(window) : std::make_shared<OffscreenWindow>(width, height))
{
  this->Window->Window()->SetNumberOfLayers(2);
  this->AddPanel({ 0, 0, width, height }, background);
  this->Overlay = this->NewRenderer({ 0, 0, width, height }, 1);
}

//------------------------------------------------------------------------------
Canvas::~Canvas()
{
  for (const vtkSmartPointer<vtkRenderer>& renderer : this->Renderers)
  {
    this->Window->Window()->RemoveRenderer(renderer);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRenderer> Canvas::NewRenderer(const Box& box, int layer)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetLayer(layer);
  renderer->SetViewport(static_cast<double>(box.X) / this->Width,
    1 - static_cast<double>(box.Y + box.Height) / this->Height,
    static_cast<double>(box.X + box.Width) / this->Width,
    1 - static_cast<double>(box.Y) / this->Height);
  this->Window->Window()->AddRenderer(renderer);
  this->Renderers.push_back(renderer);
  return renderer;
}

//------------------------------------------------------------------------------
vtkRenderer* Canvas::AddPanel(const Box& box, const Colour& background)
{
  vtkSmartPointer<vtkRenderer> renderer = this->NewRenderer(box, 0);
  renderer->SetBackground(background[0], background[1], background[2]);
  renderer->UseFXAAOn(); // smooth lines, in half the time of four samples per pixel
  return renderer;
}

//------------------------------------------------------------------------------
Box Canvas::AddPicture(vtkImageData* picture, const Box& box)
{
  const Box fitted = Fitted(box, picture->GetDimensions()[0], picture->GetDimensions()[1]);
  vtkNew<vtkImageResize> resize;
  resize->SetInputData(ColorAlone(picture));
  resize->SetOutputDimensions(fitted.Width, fitted.Height, 1);
  resize->BorderOn();
  resize->Update();
  // With spacing 1 and a viewport of as many pixels, one pixel of the image is one of the window.
  vtkNew<vtkImageData> pixels;
  pixels->DeepCopy(resize->GetOutput());
  pixels->SetOrigin(0, 0, 0);
  pixels->SetSpacing(1, 1, 1);
  vtkNew<vtkImageActor> actor;
  actor->SetInputData(pixels);
  actor->InterpolateOff();
  vtkRenderer* renderer = this->AddPanel(fitted, colours::Panel);
  renderer->UseFXAAOff(); // every pixel as it is
  renderer->AddActor(actor);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint((fitted.Width - 1) / 2.0, (fitted.Height - 1) / 2.0, 0);
  camera->SetPosition((fitted.Width - 1) / 2.0, (fitted.Height - 1) / 2.0, 1);
  camera->SetParallelScale(fitted.Height / 2.0);
  camera->SetClippingRange(0.1, 2);
  return fitted;
}

//------------------------------------------------------------------------------
void Canvas::AddChart(vtkChartXY* chart, const Box& box, const Colour& background)
{
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  this->AddPanel(box, background)->AddActor(actor);
}

//------------------------------------------------------------------------------
void Canvas::AddColourBar(vtkScalarsToColors* table, const Box& box, const char* format)
{
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat(format);
  bar->UnconstrainedFontSizeOn();
  bar->SetTextPositionToSucceedScalarBar();
  bar->SetBarRatio(0.3);
  bar->SetTitle("");
  vtkTextProperty* text = bar->GetLabelTextProperty();
  text->SetFontSize(13);
  text->SetColor(colours::Text.data());
  text->ItalicOff();
  text->BoldOff();
  text->ShadowOff();
  bar->SetPosition(static_cast<double>(box.X) / this->Width,
    1 - static_cast<double>(box.Y + box.Height) / this->Height);
  bar->SetWidth(static_cast<double>(box.Width) / this->Width);
  bar->SetHeight(static_cast<double>(box.Height) / this->Height);
  this->Overlay->AddViewProp(bar);
}

//------------------------------------------------------------------------------
void Canvas::AddText(const std::string& text, int x, int y, const TextStyle& style)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(ValidUtf8(text).c_str());
  actor->SetDisplayPosition(x, this->Height - y);
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontSize(style.SizePx);
  property->SetColor(style.Ink.data());
  property->SetBold(style.Bold);
  property->SetVerticalJustificationToCentered();
  property->SetJustification(style.Align == TextStyle::Left ? VTK_TEXT_LEFT
      : style.Align == TextStyle::Centre                    ? VTK_TEXT_CENTERED
                                                            : VTK_TEXT_RIGHT);
  this->Overlay->AddViewProp(actor);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> Canvas::Draw()
{
  ThrowIfStopRequested(); // drawing may take as long as all that led to it
  return this->Window->Capture();
}
}
