// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/QuietCompressor.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

#include <utility>

namespace novelview
{
namespace
{
const unsigned char* Unsigned(const char* bytes)
{
  return reinterpret_cast<const unsigned char*>(bytes);
}

unsigned char* Unsigned(char* bytes)
{
  return reinterpret_cast<unsigned char*>(bytes);
}
}

QuietCompressor::QuietCompressor(vtkSmartPointer<vtkDataCompressor> compressor)
  : Compressor(std::move(compressor))
{
  // An error that is observed is not printed.
  const vtkNew<vtkCallbackCommand> nothing;
  this->Compressor->AddObserver(vtkCommand::ErrorEvent, nothing);
  this->Compressor->AddObserver(vtkCommand::WarningEvent, nothing);
}

std::string QuietCompressor::Compress(std::string_view bytes)
{
  std::string block(this->Compressor->GetMaximumCompressionSpace(bytes.size()), '\0');
  block.resize(this->Compressor->Compress(
    Unsigned(bytes.data()), bytes.size(), Unsigned(block.data()), block.size()));
  return block;
}

bool QuietCompressor::Uncompress(std::string_view block, char* to, std::size_t size)
{
  return this->Compressor->Uncompress(Unsigned(block.data()), block.size(), Unsigned(to), size) ==
    size;
}
}
