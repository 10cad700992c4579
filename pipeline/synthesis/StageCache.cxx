// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/StageCache.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "core/Error.h"
#include "crust/PowerCrust.h"
#include "synthesis/CacheFile.h"
#include "synthesis/Synthesis.h"
#include "vtkReferenceDepthEstimator.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
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
  void AddText(const std::string& text)
  {
    this->AddValue(text.size());
    this->Add(text.data(), text.size());
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

/** The file of the library, or program, that contains a function. */
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

/** All options but those that only matter once there is a novel camera. */
void AddOptions(Hash& hash, SynthesisOptions options)
{
  for (const Option& option : OptionsOf(options))
  {
    if (option.OfScene)
    {
      hash.AddText(option.Key);
      hash.AddText(ValueText(option));
    }
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
    const CacheFile file(this->Entry(), this->Key);
    return UnpackScene({ file.Names(), [&file](const std::string& name) { return file.Read(name); },
                         [&file](const std::string& name) { return file.Where(name); } },
      this->Views);
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
  WriteDespiteStop(this->Entry(), ComposeCacheFile(this->Key, PackScene(results, this->Views)));
}
}
