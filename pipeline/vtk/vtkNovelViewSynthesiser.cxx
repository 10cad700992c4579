// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkNovelViewSynthesiser.h"

#include "FilterSupport.h"
#include "base/JsonFile.h"
#include "synthesis/Synthesis.h"
#include "synthesis/SynthesisOptions.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <utility>

vtkStandardNewMacro(vtkNovelViewSynthesiser);

//------------------------------------------------------------------------------
/** The options, and the chain that was built with them as long as it can be used again. */
class vtkNovelViewSynthesiser::Internals
{
public:
  /** The options after a change; throws and leaves them alone when that cannot be made. */
  static novelview::SynthesisOptions Changed(novelview::SynthesisOptions options,
    const std::string& json, const novelview::OptionWarning& warn)
  {
    const char* const where = "options";
    const auto object = novelview::ParseJson(json, where);
    if (!object.is_object())
    {
      throw novelview::Error(where, "are no JSON object", object.type_name(), "an object");
    }
    if (const auto preset = object.find("preset"); preset != object.end() && preset->is_string())
    {
      options = novelview::PresetOptions(preset->get<std::string>());
    }
    novelview::SetFromJson(novelview::OptionsOf(options), object, {}, where, warn);
    return options;
  }

  novelview::Synthesis& ChainFor(vtkMultiBlockDataSet* views, vtkNovelViewSynthesiser* self)
  {
    if (!this->Chain || this->Views != views || this->ViewsTime != views->GetMTime())
    {
      novelview::SynthesisListener listener;
      listener.Progress = [self](const std::string& stage, double fraction)
      {
        self->SetProgressText(stage.c_str());
        self->UpdateProgress(fraction);
        return !self->GetAbortExecute();
      };
      listener.Warn = [self](const std::string& text) { vtkWarningWithObjectMacro(self, << text); };
      this->Chain = std::make_unique<novelview::Synthesis>(views, this->Options, listener);
      this->Views = views;
      this->ViewsTime = views->GetMTime();
    }
    return *this->Chain;
  }

  void SetOptions(novelview::SynthesisOptions options)
  {
    this->Options = std::move(options);
    this->Chain.reset();
  }

  novelview::SynthesisOptions Options = novelview::PresetOptions("best");

private:
  std::unique_ptr<novelview::Synthesis> Chain;
  vtkSmartPointer<vtkMultiBlockDataSet> Views;
  vtkMTimeType ViewsTime = 0;
};

//------------------------------------------------------------------------------
vtkNovelViewSynthesiser::vtkNovelViewSynthesiser()
  : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkNovelViewSynthesiser::~vtkNovelViewSynthesiser() = default;

//------------------------------------------------------------------------------
void vtkNovelViewSynthesiser::SetCamera(vtkPinholeCamera* camera)
{
  novelview::SetCameraMember(this, this->Camera, camera);
}

//------------------------------------------------------------------------------
vtkPinholeCamera* vtkNovelViewSynthesiser::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkNovelViewSynthesiser::GetMTime()
{
  return novelview::MTimeWithCamera(this->Superclass::GetMTime(), this->Camera);
}

//------------------------------------------------------------------------------
void vtkNovelViewSynthesiser::SetPreset(const char* name)
{
  try
  {
    this->Impl->SetOptions(novelview::PresetOptions(name ? name : ""));
    this->Modified();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< novelview::ErrorText(error));
  }
}

//------------------------------------------------------------------------------
std::string vtkNovelViewSynthesiser::GetPreset()
{
  return this->Impl->Options.Preset;
}

//------------------------------------------------------------------------------
bool vtkNovelViewSynthesiser::SetOptions(const char* json)
{
  try
  {
    const auto warn = [this](const std::string& text) { vtkWarningMacro(<< text); };
    this->Impl->SetOptions(Internals::Changed(this->Impl->Options, json ? json : "", warn));
    this->Modified();
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< novelview::ErrorText(error));
    return false;
  }
}

//------------------------------------------------------------------------------
std::string vtkNovelViewSynthesiser::GetOptions()
{
  return novelview::DumpJson(novelview::ToJson(novelview::OptionsOf(this->Impl->Options), "."), -1);
}

//------------------------------------------------------------------------------
std::string vtkNovelViewSynthesiser::GetOptionHelp(const char* name)
{
  for (const novelview::Option& option : novelview::OptionsOf(this->Impl->Options))
  {
    if (name && option.Key == name)
    {
      const std::string range = novelview::RangeText(option);
      std::string facts = option.Unit;
      facts += option.Unit.empty() || range.empty() ? range : "; " + range;
      return option.Help + (facts.empty() ? "" : " (" + facts + ")");
    }
  }
  return "";
}

//------------------------------------------------------------------------------
vtkPolyData* vtkNovelViewSynthesiser::GetMesh()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
int vtkNovelViewSynthesiser::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkNovelViewSynthesiser::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkImageData" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkNovelViewSynthesiser::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  novelview::SetPictureInformation(outputs, this->Camera);
  return 1;
}

//------------------------------------------------------------------------------
int vtkNovelViewSynthesiser::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      const novelview::Camera camera = novelview::RequireCamera(this->Camera);
      const novelview::NovelView view =
        this->Impl->ChainFor(vtkMultiBlockDataSet::GetData(inputs[0]), this)
          .Render(camera, static_cast<novelview::Stage>(this->Stage));
      vtkImageData* image = vtkImageData::GetData(outputs, 0);
      image->ShallowCopy(view.Image);
      image->GetPointData()->SetActiveScalars(novelview::arrays::Color);
      vtkPolyData::GetData(outputs, 1)->ShallowCopy(view.Mesh);
    });
}

//------------------------------------------------------------------------------
void vtkNovelViewSynthesiser::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  novelview::PrintCamera(os, indent, this->Camera);
  os << indent << "Stage: " << this->Stage << "\n";
  os << indent << "Options: " << this->GetOptions() << "\n";
}
