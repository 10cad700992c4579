// SPDX-License-Identifier: GPL-3.0-or-later
#include "StageCache.h"

#include "Error.h"
#include "Parallel.h"
#include "PowerCrust.h"
#include "Synthesis.h"
#include "ViewAccess.h"
#include "vtkReferenceDepthEstimator.h"

#include <nlohmann/json.hpp>

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <dlfcn.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <fstream>
#include <memory>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
constexpr const char* Manifest = "manifest.json";

/** A running XXH3 hash. */
class Hash
{
public:
  Hash()
    : State(XXH3_createState(), XXH3_freeState)
  {
    XXH3_128bits_reset(this->State.get());
  }
  void Add(const void* bytes, std::size_t count)
  {
    XXH3_128bits_update(this->State.get(), bytes, count);
  }
  template <class T>
  void AddValue(const T& value)
  {
    this->Add(&value, sizeof(value));
  }
  void AddFile(const fs::path& path)
  {
    std::ifstream in(path, std::ios::binary);
    std::vector<char> block(1 << 20);
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
    {
      this->Add(block.data(), static_cast<std::size_t>(in.gcount()));
    }
  }
  std::string Text() const
  {
    const XXH128_hash_t value = XXH3_128bits_digest(this->State.get());
    char text[33];
    std::snprintf(text, sizeof(text), "%016llx%016llx",
      static_cast<unsigned long long>(value.high64), static_cast<unsigned long long>(value.low64));
    return text;
  }

private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> State;
};

std::string HashOfFile(const fs::path& path)
{
  Hash hash;
  hash.AddFile(path);
  return hash.Text();
}

/** The file of the library, or program, that holds a function. */
fs::path FileOf(const void* function)
{
  Dl_info info;
  return dladdr(function, &info) && info.dli_fname ? fs::path(info.dli_fname) : fs::path();
}

/** Results of other code are not ours: the files of kernels, filters and their wiring count. */
void AddCode(Hash& hash)
{
  hash.AddFile(FileOf(reinterpret_cast<const void*>(&ComputePowerCrust)));
  hash.AddFile(FileOf(reinterpret_cast<const void*>(&vtkReferenceDepthEstimator::New)));
  hash.AddFile(FileOf(reinterpret_cast<const void*>(&PresetOptions)));
}

void AddOptions(Hash& hash, const SynthesisOptions& options)
{
  hash.AddValue(options.ReconcileSilhouettes);
  hash.AddValue(options.HullSpacingPx);
  hash.AddValue(options.HullKeepAll);
  hash.AddValue(options.UseDepthMaps);
  hash.AddValue(options.HullBox.has_value());
  for (int i = 0; i < 6 && options.HullBox; ++i)
  {
    hash.AddValue((*options.HullBox)[i]);
  }
}

void AddView(Hash& hash, vtkImageData* image, const std::string& name)
{
  const Camera camera = AttachedCamera(image, name);
  hash.AddValue(camera.Width);
  hash.AddValue(camera.Height);
  hash.Add(camera.K.data(), 9 * sizeof(double));
  hash.Add(camera.R.data(), 9 * sizeof(double));
  hash.Add(camera.T.data(), 3 * sizeof(double));
  for (const char* array : { arrays::Color, arrays::Mask, arrays::ContourDistance })
  {
    if (vtkDataArray* data = image->GetPointData()->GetArray(array))
    {
      hash.Add(data->GetVoidPointer(0),
        static_cast<std::size_t>(data->GetDataSize()) * data->GetDataTypeSize());
    }
  }
}

template <class Writer>
void Write(vtkDataObject* data, const fs::path& path, nlohmann::json& files)
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(data);
  writer->SetFileName(path.c_str());
  writer->SetCompressorTypeToLZ4();
  writer->EncodeAppendedDataOff();
  if (writer->Write() != 1)
  {
    throw Error(path.string(), "cannot be written");
  }
  files[path.filename().string()] = HashOfFile(path);
}

template <class Reader>
auto Read(const fs::path& path, const nlohmann::json& files)
{
  if (HashOfFile(path) != files.at(path.filename().string()).get<std::string>())
  {
    throw Error(path.string(), "its checksum is wrong");
  }
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return vtkSmartPointer(reader->GetOutput());
}

std::string ViewFile(std::size_t viewId)
{
  char name[32];
  std::snprintf(name, sizeof(name), "view_%04zu.vti", viewId);
  return name;
}

/** The arrays and numbers of `made` that `given` has not. */
vtkSmartPointer<vtkImageData> NewParts(vtkImageData* made, vtkImageData* given)
{
  auto parts = vtkSmartPointer<vtkImageData>::New();
  parts->CopyStructure(made);
  for (int i = 0; i < made->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = made->GetPointData()->GetArray(i);
    if (array && given->GetPointData()->GetArray(array->GetName()) != array)
    {
      parts->GetPointData()->AddArray(array);
    }
  }
  for (const char* number : { arrays::ExposureGain, arrays::ContourOffset })
  {
    if (vtkAbstractArray* array = made->GetFieldData()->GetAbstractArray(number))
    {
      parts->GetFieldData()->AddArray(array);
    }
  }
  return parts;
}

/** A view with the kept parts on top of what is given. */
vtkSmartPointer<vtkImageData> Completed(vtkImageData* given, vtkImageData* parts)
{
  int size[3];
  int keptSize[3];
  given->GetDimensions(size);
  parts->GetDimensions(keptSize);
  if (!std::equal(size, size + 3, keptSize))
  {
    throw Error("a kept view", "is not of the photograph's size");
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->ShallowCopy(given);
  for (int i = 0; i < parts->GetPointData()->GetNumberOfArrays(); ++i)
  {
    image->GetPointData()->AddArray(parts->GetPointData()->GetArray(i));
  }
  vtkNew<vtkFieldData> field; // the given view's stays as it is
  field->ShallowCopy(given->GetFieldData());
  for (int i = 0; i < parts->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    field->AddArray(parts->GetFieldData()->GetAbstractArray(i));
  }
  image->SetFieldData(field);
  return image;
}

void WriteEntry(const fs::path& folder, const ViewIndependent& results, vtkMultiBlockDataSet* given)
{
  nlohmann::json files;
  Write<vtkXMLPolyDataWriter>(results.Hull, folder / "hull.vtp", files);
  Write<vtkXMLPolyDataWriter>(results.Crust, folder / "crust.vtp", files);
  Write<vtkXMLPolyDataWriter>(results.MedialBalls, folder / "medial_balls.vtp", files);
  for (unsigned int viewId = 0; viewId < given->GetNumberOfBlocks(); ++viewId)
  {
    const auto parts = NewParts(ViewImage(results.Views, viewId), ViewImage(given, viewId));
    Write<vtkXMLImageDataWriter>(parts, folder / ViewFile(viewId), files);
  }
  nlohmann::json numbers;
  for (const char* number : { arrays::DepthNoise, arrays::SilhouettePrior })
  {
    const double value = AttachedNumber(results.Views, number, -1);
    if (value >= 0)
    {
      numbers[number] = value;
    }
  }
  const nlohmann::json manifest = { { "files", files }, { "numbers", numbers },
    { "warnings", results.Warnings } };
  // The whole folder gets its name at the end, and an interrupt shall not lose it.
  const fs::path path = folder / Manifest;
  std::ofstream file(path, std::ios::binary);
  file << manifest.dump(1) << "\n";
  file.close();
  if (!file)
  {
    throw Error(path.string(), "cannot be written");
  }
}

ViewIndependent ReadEntry(const fs::path& folder, vtkMultiBlockDataSet* given)
{
  const nlohmann::json manifest = nlohmann::json::parse(std::ifstream(folder / Manifest));
  const nlohmann::json& files = manifest.at("files");
  ViewIndependent results;
  results.Hull = Read<vtkXMLPolyDataReader>(folder / "hull.vtp", files);
  results.Crust = Read<vtkXMLPolyDataReader>(folder / "crust.vtp", files);
  results.MedialBalls = Read<vtkXMLPolyDataReader>(folder / "medial_balls.vtp", files);
  results.Warnings = manifest.at("warnings").get<std::vector<std::string>>();
  results.Views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  std::vector<vtkSmartPointer<vtkImageData>> parts(given->GetNumberOfBlocks());
  ParallelForEach(parts.size(),
    [&](std::size_t viewId)
    { parts[viewId] = Read<vtkXMLImageDataReader>(folder / ViewFile(viewId), files); });
  for (unsigned int viewId = 0; viewId < parts.size(); ++viewId)
  {
    vtkImageData* image = ViewImage(given, viewId);
    const std::string name = ViewName(given, viewId);
    AppendView(results.Views, name, Completed(image, parts[viewId]), AttachedCamera(image, name));
  }
  for (const auto& [name, value] : manifest.at("numbers").items())
  {
    AttachNumber(results.Views, name.c_str(), value.get<double>());
  }
  return results;
}
}

StageCache::StageCache(
  fs::path folder, vtkMultiBlockDataSet* views, const SynthesisOptions& options)
  : Folder(std::move(folder))
  , Views(views)
{
  Hash hash;
  AddCode(hash);
  AddOptions(hash, options);
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    AddView(hash, ViewImage(views, viewId), ViewName(views, viewId));
  }
  this->Key = hash.Text();
}

std::optional<ViewIndependent> StageCache::Load()
{
  this->Wrong.clear();
  if (!fs::exists(this->Entry() / Manifest))
  {
    return {};
  }
  try
  {
    return ReadEntry(this->Entry(), this->Views);
  }
  catch (const Interrupted&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    this->Wrong = error.what();
    return {};
  }
}

void StageCache::Store(const ViewIndependent& results) const
{
  const fs::path temporary = this->Folder / (this->Key + "." + std::to_string(getpid()) + ".tmp");
  try
  {
    fs::create_directories(temporary);
    WriteEntry(temporary, results, this->Views);
    fs::remove_all(this->Entry());
    fs::rename(temporary, this->Entry());
  }
  catch (const fs::filesystem_error& error)
  {
    std::error_code ignored;
    fs::remove_all(temporary, ignored);
    throw Error(this->Folder.string(), "the cache cannot be written: " + error.code().message());
  }
  catch (...)
  {
    std::error_code ignored;
    fs::remove_all(temporary, ignored);
    throw;
  }
}
}
