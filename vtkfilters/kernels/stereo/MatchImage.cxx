// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/MatchImage.h"

#include <algorithm>

namespace novelview
{
MatchImage MakeMatchImage(const View& view, int reduction)
{
  MatchImage image;
  image.Cam = view.Cam;
  image.Cam.Width = view.Cam.Width / reduction;
  image.Cam.Height = view.Cam.Height / reduction;
  image.Cam.K.topRows<2>() /= reduction;
  // The small pixel x covers reduction pixels whose middle is reduction x + (reduction - 1) / 2.
  image.Cam.K(0, 2) -= 0.5 * (reduction - 1) / reduction;
  image.Cam.K(1, 2) -= 0.5 * (reduction - 1) / reduction;
  image.Pixels = Image<std::uint8_t>(image.Cam.Width, image.Cam.Height, 4);
  for (int y = 0; y < image.Cam.Height; ++y)
  {
    for (int x = 0; x < image.Cam.Width; ++x)
    {
      int count = 0;
      int sum[3] = { 0, 0, 0 };
      for (int n = 0; n < reduction * reduction; ++n)
      {
        const int i = x * reduction + n % reduction;
        const int j = y * reduction + n / reduction;
        if (view.IsObject(i, j))
        {
          ++count;
          for (int channel = 0; channel < 3; ++channel)
          {
            sum[channel] += view.Color(i, j, channel);
          }
        }
      }
      if (2 * count < reduction * reduction || count == 0)
      {
        continue;
      }
      int rgb[3];
      for (int channel = 0; channel < 3; ++channel)
      {
        rgb[channel] = (sum[channel] + count / 2) / count;
        image.Pixels(x, y, channel) = static_cast<std::uint8_t>(rgb[channel]);
      }
      const int luma = (299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000;
      image.Pixels(x, y, 3) = static_cast<std::uint8_t>(std::max(luma, 1));
    }
  }
  return image;
}
}
