// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_QuietCompressor_h
#define novelview_QuietCompressor_h

#include <vtkDataCompressor.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace novelview
{
/** A compressor of VTK that prints nothing: errors are reported by return values only. */
class QuietCompressor
{
public:
  explicit QuietCompressor(vtkSmartPointer<vtkDataCompressor> compressor);

  /** The bytes compressed; empty = failed. */
  std::string Compress(std::string_view bytes);

  /** Puts what a block contains at `to`; false when that is not `size` bytes. */
  bool Uncompress(std::string_view block, char* to, std::size_t size);

private:
  const vtkSmartPointer<vtkDataCompressor> Compressor;
};
}

#endif
