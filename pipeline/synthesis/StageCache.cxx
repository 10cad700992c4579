// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/StageCache.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/ByteStream.h"
#include "base/Parallel.h"
#include "core/Error.h"
#include "crust/PowerCrust.h"
#include "synthesis/CacheFile.h"
#include "synthesis/DataBytes.h"
#include "synthesis/Synthesis.h"
#include "vtkReferenceDepthEstimator.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <dlfcn.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fstream>
#include <memory>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
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

/** A view's section. */
std::string ViewSection(std::size_t viewId)
{
  return "view " + std::to_string(viewId);
}

constexpr const char* HullSection = "hull";
constexpr const char* CrustSection = "crust";
constexpr const char* BallsSection = "medial balls";
constexpr const char* NotesSection = "notes";

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

/** The numbers of all views, below 0 = none, and the warnings. */
std::string PackedNotes(const SceneGeometry& results)
{
  ByteWriter writer;
  for (const char* number : SharedNumbers)
  {
    writer.Add<double>(AttachedNumber(results.Views, number, -1));
  }
  writer.Add<std::uint64_t>(results.Warnings.size());
  for (const std::string& warning : results.Warnings)
  {
    writer.AddText(warning);
  }
  return std::move(writer.Written);
}

void UnpackNotes(std::string_view bytes, const std::string& where, SceneGeometry& results)
{
  ByteReader reader(bytes, where);
  for (const char* number : SharedNumbers)
  {
    if (const auto value = reader.Take<double>(); value >= 0)
    {
      AttachNumber(results.Views, number, value);
    }
  }
  const auto count = reader.Take<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    results.Warnings.push_back(reader.TakeText());
  }
  reader.RequireEnd();
}

std::string PackedEntry(
  const std::string& key, const SceneGeometry& results, vtkMultiBlockDataSet* given)
{
  std::vector<CacheSection> sections = { { HullSection, PackedMesh(results.Hull) },
    { CrustSection, PackedMesh(results.Crust) }, { BallsSection, PackedMesh(results.MedialBalls) },
    { NotesSection, PackedNotes(results) } };
  for (unsigned int viewId = 0; viewId < given->GetNumberOfBlocks(); ++viewId)
  {
    const auto parts = NewParts(ViewImage(results.Views, viewId), ViewImage(given, viewId));
    sections.push_back({ ViewSection(viewId), PackedImage(parts) });
  }
  return ComposeCacheFile(key, std::move(sections));
}

/** Reads, checks and unpacks the sections, spread over the threads. */
SceneGeometry ReadEntry(const CacheFile& file, vtkMultiBlockDataSet* given)
{
  SceneGeometry results;
  std::vector<vtkSmartPointer<vtkImageData>> parts(given->GetNumberOfBlocks());
  const auto mesh = [&file](const char* name)
  { return UnpackedMesh(file.Read(name), file.Where(name)); };
  ParallelForEach(parts.size() + 3,
    [&](std::size_t i)
    {
      switch (i)
      {
        case 0:
          results.Crust = mesh(CrustSection);
          break;
        case 1:
          results.Hull = mesh(HullSection);
          break;
        case 2:
          results.MedialBalls = mesh(BallsSection);
          break;
        default:
          const std::string name = ViewSection(i - 3);
          parts[i - 3] = UnpackedImage(file.Read(name), file.Where(name));
      }
    });
  results.Views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int viewId = 0; viewId < parts.size(); ++viewId)
  {
    vtkImageData* image = ViewImage(given, viewId);
    const std::string name = ViewName(given, viewId);
    AppendView(results.Views, name, Completed(image, parts[viewId]), AttachedCamera(image, name));
  }
  UnpackNotes(file.Read(NotesSection), file.Where(NotesSection), results);
  // Whatever the stages would stumble over.
  ReadViews(results.Views, {});
  ToTriangleMesh(results.Crust, file.Where(CrustSection));
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

std::optional<SceneGeometry> StageCache::Load()
{
  this->Wrong.clear();
  if (!CacheFile::Exists(this->Entry()))
  {
    return {};
  }
  try
  {
    return ReadEntry(CacheFile(this->Entry(), this->Key), this->Views);
  }
  catch (const Interrupted&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    this->Wrong = ErrorText(error);
  }
  return {};
}

void StageCache::Store(const SceneGeometry& results) const
{
  WriteDespiteStop(this->Entry(), PackedEntry(this->Key, results, this->Views));
}
}
