// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/ErrorPicture.h"

#include "ViewAccess.h"
#include "core/Error.h"
#include "drawing/Canvas.h"

#include <cmath>

namespace novelview
{
vtkSmartPointer<vtkColorTransferFunction> HeatColours(double most)
{
  auto table = vtkSmartPointer<vtkColorTransferFunction>::New();
  table->AddRGBPoint(0.00 * most, 0.02, 0.02, 0.06);
  table->AddRGBPoint(0.25 * most, 0.34, 0.06, 0.43);
  table->AddRGBPoint(0.50 * most, 0.73, 0.21, 0.33);
  table->AddRGBPoint(0.75 * most, 0.98, 0.55, 0.04);
  table->AddRGBPoint(1.00 * most, 0.99, 1.00, 0.64);
  return table;
}

vtkSmartPointer<vtkImageData> ErrorPicture(
  vtkImageData* novel, vtkImageData* truth, vtkScalarsToColors* table)
{
  const auto a = TopDownArray<const std::uint8_t>(novel, arrays::Color, 3, "novel view", true);
  const auto b = TopDownArray<const std::uint8_t>(truth, arrays::Color, 3, "truth", true);
  const auto maskA = TopDownArray<const std::uint8_t>(novel, arrays::Mask, 1, "novel view", false);
  const auto maskB = TopDownArray<const std::uint8_t>(truth, arrays::Mask, 1, "truth", false);
  if (a.Width != b.Width || a.Height != b.Height)
  {
    throw Error("screenshot", "truth and novel view differ in size", SizeText(b.Width, b.Height),
      SizeText(a.Width, a.Height));
  }
  const bool everywhere = maskA.Empty() || maskB.Empty();
  vtkSmartPointer<vtkImageData> picture = NewImage(a.Width, a.Height);
  const auto out = AddTopDownArray<std::uint8_t>(picture, arrays::Color, 3);
  for (int y = 0; y < a.Height; ++y)
  {
    for (int x = 0; x < a.Width; ++x)
    {
      Colour colour = { 0.16, 0.18, 0.21 };
      if (everywhere || maskA(x, y) > 127 || maskB(x, y) > 127)
      {
        double sum = 0;
        for (int c = 0; c < 3; ++c)
        {
          sum += std::abs(a(x, y, c) - b(x, y, c));
        }
        table->GetColor(sum / 3, colour.data());
      }
      for (int c = 0; c < 3; ++c)
      {
        out(x, y, c) = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
      }
    }
  }
  return picture;
}
}
