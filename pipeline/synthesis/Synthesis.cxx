// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/Synthesis.h"

#include "ViewAccess.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "synthesis/SceneRunner.h"
#include "synthesis/StageCache.h"
#include "synthesis/StageRunner.h"
#include "vtkPinholeCamera.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>

#include <algorithm>
#include <utility>

namespace novelview
{
namespace
{
/** An image without a single pixel of the object is nothing to hand out silently. */
void RequireObject(vtkImageData* image)
{
  const auto mask = TopDownArray<const unsigned char>(image, arrays::Mask, 1, "novel view", true);
  for (int y = 0; y < mask.Height; ++y)
  {
    if (std::any_of(mask.Row(y), mask.Row(y) + mask.Width, [](auto value) { return value > 127; }))
    {
      return;
    }
  }
  throw Error("novel camera", "the object covers no pixel of its picture: it is too far away");
}
}

class Synthesis::Internals
{
public:
  Internals(
    vtkMultiBlockDataSet* views, const SynthesisOptions& options, SynthesisListener listener)
    : Options(options)
    , Listener(std::move(listener))
    , Filters(views, options)
    , Scene(this->Filters, this->Options, this->Listener)
  {
    if (!options.Cache.empty())
    {
      this->Cache.emplace(options.Cache, views, options);
    }
  }

  Internals(
    const SceneGeometry& prepared, const SynthesisOptions& options, SynthesisListener listener)
    : Options(options)
    , Listener(std::move(listener))
    , Filters(prepared.Views, options)
    , Scene(this->Filters, this->Options, this->Listener)
    , Kept(prepared)
  {
    this->UseKept();
  }

  SceneGeometry Prepared()
  {
    this->Prepare();
    return this->Kept ? *this->Kept : this->Results();
  }

  /** The hull at least; with a cache, all that does not depend on the novel camera. */
  vtkPolyData* Hull()
  {
    if (!this->Load())
    {
      this->Scene.MakeHull();
    }
    return this->Kept ? this->Kept->Hull.Get() : this->Filters.HullSource->GetOutput();
  }

  vtkPolyData* Crust()
  {
    if (!this->Load())
    {
      this->Scene.MakeHullAndCrust();
    }
    return this->Kept ? this->Kept->Crust.Get() : this->Filters.Mesher->GetOutput();
  }

  vtkPolyData* MedialBalls()
  {
    this->Crust();
    return this->Kept ? this->Kept->MedialBalls.Get()
                      : vtkPolyData::SafeDownCast(this->Filters.Mesher->GetOutputDataObject(1));
  }

  vtkMultiBlockDataSet* Photographs()
  {
    this->Prepare();
    if (this->Kept)
    {
      return this->Kept->Views;
    }
    // Without depth maps they have not been computed yet.
    vtkAlgorithm* source = this->Filters.Mapper->GetInputAlgorithm(1, 0);
    source->Update();
    return vtkMultiBlockDataSet::SafeDownCast(source->GetOutputDataObject(0));
  }

  vtkPolyData* WholeObject(Stage upTo)
  {
    vtkPolyData* crust = this->Crust();
    if (upTo == Stage::Hull || !this->Options.UseDepthMaps)
    {
      return crust;
    }
    vtkDepthMapFuser* fuser = this->Filters.Fuser;
    const double noise = DepthNoiseOf(this->Photographs(), fuser->GetDepthNoise());
    if (noise > FusedSurfaceOptions::MaxDepthNoise)
    {
      this->Scene.Warn("mesh: depth maps of neighbouring photographs differ by " +
        Formatted("%.1f px", noise) +
        ", too much to be fused; the mesh is the power crust of the hull");
      return crust;
    }
    fuser->SetInputData(0, crust);
    fuser->SetInputData(1, this->Photographs());
    this->Run("mesh", fuser);
    if (const int dropped = fuser->GetNumberOfDroppedComponents(); dropped > 0)
    {
      this->Scene.Warn("mesh: " + std::to_string(dropped) + " smaller component(s) with " +
        std::to_string(fuser->GetNumberOfDroppedTriangles()) +
        " triangles left out; --hull-keep-all keeps them");
    }
    return fuser->GetOutput();
  }

  /** With `all`, every stage is textured; otherwise only the last. */
  std::vector<NovelView> Render(const Camera& camera, Stage upTo, bool all)
  {
    this->Filters.SetCamera(camera);
    this->Prepare();
    this->Run("culling", this->Filters.Culler);
    this->Filters.Mapper->SetInputConnection(2, this->Filters.Culler->GetOutputPort(1));
    std::vector<NovelView> views;
    const auto add = [&](vtkPolyDataAlgorithm* filter, Stage stage)
    {
      if (all || stage == upTo)
      {
        NovelView& view = views.emplace_back();
        view.Mesh = vtkSmartPointer<vtkPolyData>::New();
        view.Mesh->ShallowCopy(filter->GetOutput());
        view.Image = this->Textured(view.Mesh, "texture");
        RequireObject(view.Image);
      }
    };
    add(this->Filters.Culler, Stage::Hull);
    if (upTo != Stage::Hull)
    {
      this->RunDeformer("outline", this->Filters.Outline, Stage::Outline);
      add(this->Filters.Outline, Stage::Outline);
    }
    if (upTo == Stage::Full)
    {
      this->RunDeformer("non-outline", this->Filters.NonOutline, Stage::Full);
      add(this->Filters.NonOutline, Stage::Full);
    }
    return views;
  }

  vtkSmartPointer<vtkImageData> Texture(vtkPolyData* mesh, const Camera& camera)
  {
    this->Filters.Mapper->SetCamera(NewPinholeCamera(camera));
    this->Filters.Mapper->RemoveAllInputConnections(2);
    return this->Textured(mesh, "texture");
  }

private:
  /** Runs every stage before the novel camera, or takes what they made from the cache. */
  void Prepare()
  {
    if (this->Load())
    {
      return;
    }
    this->Scene.MakeAll();
    if (!this->Cache || this->Stored)
    {
      return;
    }
    this->Stored = true;
    try
    {
      this->Cache->Store(this->Results());
    }
    catch (const Interrupted&)
    {
      throw;
    }
    catch (const std::exception& error)
    {
      this->WarnOfCache(ErrorText(error) + "; nothing is kept");
    }
  }

  /** Whether the cache has all results; reads it once. */
  bool Load()
  {
    if (!this->Kept && this->Cache && !this->Looked)
    {
      this->Looked = true;
      if (this->Listener.Progress)
      {
        this->Listener.Progress("cache", 0);
      }
      this->Kept = this->Cache->Load();
      if (!this->Cache->Damage().empty())
      {
        this->WarnOfCache(this->Cache->Damage() + "; computed again");
      }
      if (this->Kept)
      {
        this->UseKept();
      }
    }
    return this->Kept.has_value();
  }

  void UseKept()
  {
    this->Filters.Culler->SetInputData(this->Kept->Crust);
    for (vtkAlgorithm* filter : this->ViewUsers())
    {
      filter->SetInputDataObject(1, this->Kept->Views);
    }
    for (const std::string& warning : this->Kept->Warnings)
    {
      this->Scene.Warn(warning);
    }
  }

  SceneGeometry Results()
  {
    SceneGeometry results;
    results.Hull = this->Filters.HullSource->GetOutput();
    results.Crust = this->Filters.Mesher->GetOutput();
    results.MedialBalls = vtkPolyData::SafeDownCast(this->Filters.Mesher->GetOutputDataObject(1));
    results.Views = vtkMultiBlockDataSet::SafeDownCast(
      this->Filters.Mapper->GetInputAlgorithm(1, 0)->GetOutputDataObject(0));
    results.Warnings = this->Scene.GetWarnings();
    return results;
  }

  /** The filters whose second input is the photographs. */
  std::array<vtkAlgorithm*, 3> ViewUsers()
  {
    return { this->Filters.Outline, this->Filters.NonOutline, this->Filters.Mapper };
  }

  /**
   * Reports problems of the cache, which no run needs: once, since an entry that cannot be read
   * often cannot be written either, and none of the warnings that are kept.
   */
  void WarnOfCache(const std::string& text)
  {
    if (!this->WarnedOfCache && this->Listener.Warn)
    {
      this->Listener.Warn("cache: " + text);
    }
    this->WarnedOfCache = true;
  }

  void Run(const std::string& stage, vtkAlgorithm* filter)
  {
    RunStage(stage, filter, this->Listener.Progress, this->Listener.StageDone);
  }

  vtkSmartPointer<vtkImageData> Textured(vtkPolyData* mesh, const char* stage)
  {
    this->Filters.Mapper->SetInputData(0, mesh);
    // Images between iterations are part of their stage and are not reported.
    stage ? this->Run(stage, this->Filters.Mapper) : RunStage("texture", this->Filters.Mapper);
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->ShallowCopy(this->Filters.Mapper->GetOutput());
    return image;
  }

  void RunDeformer(const std::string& stage, vtkViewDeformer* filter, Stage step)
  {
    vtkNew<vtkCallbackCommand> command;
    struct Context
    {
      Internals* Self;
      Stage Step;
    } context{ this, step };
    command->SetClientData(&context);
    command->SetCallback(
      [](vtkObject* caller, unsigned long, void* data, void*)
      {
        auto* heard = static_cast<Context*>(data);
        heard->Self->ReportIteration(static_cast<vtkViewDeformer*>(caller), heard->Step);
      });
    if (this->Listener.Iteration)
    {
      filter->AddObserver(vtkViewDeformer::IterationEvent, command);
      filter->Modified(); // observers do not count as a change, but this run must be watched
    }
    try
    {
      this->Run(stage, filter);
    }
    catch (...)
    {
      filter->RemoveObserver(command);
      throw;
    }
    filter->RemoveObserver(command);
  }

  void ReportIteration(vtkViewDeformer* filter, Stage step)
  {
    const auto image = this->Textured(filter->GetCurrentMesh(), nullptr);
    IterationState state;
    state.Step = step;
    state.Iteration = filter->GetIteration();
    state.MeanEnergy = filter->GetMeanEnergy();
    state.MeanPhoto = filter->GetMeanPhotoEnergy();
    state.MeanContour = filter->GetMeanContourEnergy();
    state.MeanSmooth = filter->GetMeanSmoothEnergy();
    state.PointsMoved = static_cast<long>(filter->GetPointsMoved());
    state.Mesh = filter->GetCurrentMesh();
    state.Image = image;
    this->Listener.Iteration(state);
  }

  const SynthesisOptions Options;
  const SynthesisListener Listener;
  SynthesisStages Filters;
  SceneRunner Scene;
  std::optional<StageCache> Cache;
  std::optional<SceneGeometry> Kept; ///< what the cache had
  bool Looked = false;
  bool Stored = false;
  bool WarnedOfCache = false;
};

Synthesis::Synthesis(
  vtkMultiBlockDataSet* views, const SynthesisOptions& options, SynthesisListener listener)
  : Impl(std::make_unique<Internals>(views, options, std::move(listener)))
{
}

Synthesis::Synthesis(
  const SceneGeometry& prepared, const SynthesisOptions& options, SynthesisListener listener)
  : Impl(std::make_unique<Internals>(prepared, options, std::move(listener)))
{
}

Synthesis::~Synthesis() = default;

SceneGeometry Synthesis::Prepared()
{
  return this->Impl->Prepared();
}

vtkPolyData* Synthesis::Hull()
{
  return this->Impl->Hull();
}

vtkPolyData* Synthesis::Crust()
{
  return this->Impl->Crust();
}

vtkPolyData* Synthesis::MedialBalls()
{
  return this->Impl->MedialBalls();
}

vtkMultiBlockDataSet* Synthesis::Photographs()
{
  return this->Impl->Photographs();
}

vtkPolyData* Synthesis::WholeObject(Stage upTo)
{
  return this->Impl->WholeObject(upTo);
}

NovelView Synthesis::Render(const Camera& camera, Stage upTo)
{
  return this->Impl->Render(camera, upTo, false).back();
}

std::vector<NovelView> Synthesis::RenderStages(const Camera& camera, Stage upTo)
{
  return this->Impl->Render(camera, upTo, true);
}

vtkSmartPointer<vtkImageData> Synthesis::Texture(vtkPolyData* mesh, const Camera& camera)
{
  return this->Impl->Texture(mesh, camera);
}
}
