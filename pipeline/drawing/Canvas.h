// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's images: a window laid out in panels, in pixels from the top left.
#ifndef novelview_Canvas_h
#define novelview_Canvas_h

#include "drawing/OffscreenWindow.h"

#include <vtkChartXY.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace novelview
{
/** RGB, 0 to 1. */
using Colour = std::array<double, 3>;

/** The few colours that all images share. */
namespace colours
{
inline constexpr Colour Desktop = { 0.125, 0.137, 0.157 };
inline constexpr Colour TitleBar = { 0.196, 0.216, 0.251 };
inline constexpr Colour Panel = { 0.082, 0.090, 0.106 };
inline constexpr Colour Text = { 0.90, 0.91, 0.93 };
inline constexpr Colour FaintText = { 0.62, 0.65, 0.70 };
inline constexpr Colour Reference = { 0.55, 0.70, 0.92 };
inline constexpr Colour Novel = { 1.00, 0.76, 0.18 };
inline constexpr Colour Outline = { 1.00, 0.45, 0.20 };
inline constexpr Colour NonOutline = { 0.35, 0.72, 0.95 };
}

/** What all laid-out images measure the same, pixels. */
inline constexpr int Gap = 8;
inline constexpr int TitleHeight = 44;
inline constexpr int HeaderHeight = 32;

/** A rectangle of the window, pixels, (0, 0) = top left. */
struct Box
{
  int X = 0;
  int Y = 0;
  int Width = 0;
  int Height = 0;
};

/** How text is set. */
struct TextStyle
{
  int SizePx = 15;
  Colour Ink = colours::Text;
  bool Bold = false;
  enum
  {
    Left,
    Centre,
    Right
  } Align = Left;
};

class Canvas
{
public:
  /** Draws into the `window` of that size, or a new one when there is none. */
  Canvas(int width, int height, const Colour& background,
    std::shared_ptr<OffscreenWindow> window = nullptr);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /** A panel of one colour to draw a scene in. Borrowed. */
  vtkRenderer* AddPanel(const Box& box, const Colour& background);

  /** An image (array Color, RGB), scaled to fit into the middle of the box; returns where. */
  Box AddPicture(vtkImageData* picture, const Box& box);

  void AddChart(vtkChartXY* chart, const Box& box, const Colour& background);

  /** A vertical colour bar; the box is that of the bar and the numbers to its right. */
  void AddColourBar(vtkScalarsToColors* table, const Box& box, const char* format);

  /** One line of text, vertically centred on y; x is its left end, middle or right end. */
  void AddText(const std::string& text, int x, int y, const TextStyle& style = {});

  /** What has been added, drawn. Throws Interrupted when StopRequested() (Threads.h). */
  vtkSmartPointer<vtkImageData> Draw();

private:
  vtkSmartPointer<vtkRenderer> NewRenderer(const Box& box, int layer);

  int Width;
  int Height;
  std::vector<vtkSmartPointer<vtkRenderer>> Renderers;
  vtkSmartPointer<vtkRenderer> Overlay;
  std::shared_ptr<OffscreenWindow> Window;
};
}

#endif
