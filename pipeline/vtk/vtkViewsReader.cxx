// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkViewsReader.h"

#include "FilterSupport.h"
#include "dataset/Dataset.h"
#include "dataset/PhotographSize.h"
#include "dataset/ViewSpec.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkViewsReader);

namespace
{
novelview::DatasetIndex IndexOf(const char* folder, const char* calibration, const char* format,
  const std::vector<std::string>& excludes, int maxSize)
{
  if (!folder || !*folder)
  {
    throw novelview::Error("data set", "no folder is set");
  }
  novelview::DatasetSource source;
  source.Calibration = calibration ? calibration : "";
  source.Format = format ? format : "auto";
  novelview::DatasetIndex index = novelview::ReadDatasetIndex(folder, source);
  novelview::LimitSize(
    index, excludes, maxSize < 0 ? std::optional<double>() : std::optional<double>(maxSize));
  return index;
}
}

//------------------------------------------------------------------------------
vtkViewsReader::vtkViewsReader()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkViewsReader::~vtkViewsReader()
{
  this->SetFolder(nullptr);
  this->SetCalibration(nullptr);
  this->SetFormat(nullptr);
}

//------------------------------------------------------------------------------
void vtkViewsReader::AddExclude(const char* name)
{
  if (name)
  {
    this->Excludes.emplace_back(name);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkViewsReader::RemoveAllExcludes()
{
  if (!this->Excludes.empty())
  {
    this->Excludes.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkViewsReader::GetNumberOfExcludes()
{
  return static_cast<int>(this->Excludes.size());
}

//------------------------------------------------------------------------------
const char* vtkViewsReader::GetExclude(int i)
{
  return i >= 0 && i < this->GetNumberOfExcludes() ? this->Excludes[i].c_str() : nullptr;
}

//------------------------------------------------------------------------------
bool vtkViewsReader::ReadCamera(const char* view, vtkPinholeCamera* camera)
{
  try
  {
    if (!view || !camera)
    {
      throw novelview::Error("novel view", "no text or no camera given");
    }
    const novelview::DatasetIndex index =
      IndexOf(this->Folder, this->Calibration, this->Format, this->Excludes, this->MaxSize);
    const novelview::Camera read =
      novelview::ResolveViewSpec(novelview::ParseViewSpec(view), index).Cam;
    novelview::ValidateCamera(read, view);
    novelview::FromCamera(read, camera);
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< novelview::ErrorText(error));
    return false;
  }
}

//------------------------------------------------------------------------------
int vtkViewsReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      novelview::DatasetOptions options;
      options.Exclude = this->Excludes;
      options.ForceSilhouettes = this->ForceSilhouettes;
      const novelview::Dataset dataset = novelview::ReadDataset(
        IndexOf(this->Folder, this->Calibration, this->Format, this->Excludes, this->MaxSize),
        options);
      for (const std::string& warning : dataset.Warnings)
      {
        vtkWarningMacro(<< warning);
      }
      vtkMultiBlockDataSet::GetData(outputs)->ShallowCopy(dataset.Views);
    });
}

//------------------------------------------------------------------------------
void vtkViewsReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Folder: " << (this->Folder ? this->Folder : "(none)") << "\n";
  os << indent << "Calibration: " << (this->Calibration ? this->Calibration : "(none)") << "\n";
  os << indent << "Excludes:";
  for (const std::string& name : this->Excludes)
  {
    os << " " << name;
  }
  os << "\n" << indent << "ForceSilhouettes: " << this->ForceSilhouettes << "\n";
  os << indent << "MaxSize: " << this->MaxSize << "\n";
}
