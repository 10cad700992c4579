// SPDX-License-Identifier: GPL-3.0-or-later
// What the headers of the filters say about defaults and ranges is what the filters do.
#include "vtkCameraRefiner.h"
#include "vtkDepthMapFuser.h"
#include "vtkMeshSimplifier.h"
#include "vtkNonOutlineDeformer.h"
#include "vtkOutlineDeformer.h"
#include "vtkPowerCrustMesher.h"
#include "vtkReferenceDepthEstimator.h"
#include "vtkSilhouetteReconciler.h"
#include "vtkTextureAtlasGenerator.h"
#include "vtkTsdfOutlineDeformer.h"
#include "vtkViewDependentTextureMapper.h"
#include "vtkVisibilityCuller.h"
#include "vtkVisualHullSource.h"

#include <vtkNew.h>

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>

namespace
{
/** A setter of a class, as compiled. */
struct Setter
{
  double Default = 0;
  double Min = 0;
  double Max = 1;
};

/** By "vtkClass::Name". */
using Setters = std::map<std::string, Setter>;

/** Default and range of a setter that clamps; an abstract class is asked through one derived. */
#define RANGE_OF(Class, Derived, Name)                                                             \
  {                                                                                                \
#Class "::" #Name,                                                                             \
    {                                                                                              \
      static_cast<double>(vtkNew<Derived>()->Get##Name()),                                         \
        static_cast<double>(vtkNew<Derived>()->Get##Name##MinValue()),                             \
        static_cast<double>(vtkNew<Derived>()->Get##Name##MaxValue())                              \
    }                                                                                              \
  }
#define RANGE(Class, Name) RANGE_OF(Class, Class, Name)
#define SWITCH(Class, Name)                                                                        \
  {                                                                                                \
#Class "::" #Name,                                                                             \
    {                                                                                              \
      vtkNew<Class>()->Get##Name() ? 1.0 : 0.0                                                     \
    }                                                                                              \
  }

Setters Compiled()
{
  return {
    RANGE(vtkCameraRefiner, MinGain),
    RANGE(vtkDepthMapFuser, DepthNoise),
    SWITCH(vtkDepthMapFuser, KeepAllComponents),
    RANGE(vtkDepthMapFuser, SampleSpacing),
    RANGE(vtkMeshSimplifier, NumberOfTriangles),
    RANGE(vtkNonOutlineDeformer, MatchRange),
    RANGE(vtkNonOutlineDeformer, SearchRange),
    RANGE(vtkNonOutlineDeformer, SmoothWeight),
    RANGE(vtkNonOutlineDeformer, WindowRadius),
    RANGE(vtkOutlineDeformer, ContourSigma),
    RANGE(vtkOutlineDeformer, ContourWeight),
    RANGE(vtkOutlineDeformer, SearchRange),
    RANGE(vtkOutlineDeformer, SmoothWeight),
    RANGE(vtkOutlineDeformer, WindowRadius),
    RANGE(vtkPowerCrustMesher, MinimumComponentSamples),
    SWITCH(vtkPowerCrustMesher, RecoverSamples),
    SWITCH(vtkPowerCrustMesher, UseNormals),
    RANGE(vtkReferenceDepthEstimator, ColorShare),
    RANGE(vtkReferenceDepthEstimator, Neighbours),
    RANGE(vtkReferenceDepthEstimator, SearchDepth),
    RANGE(vtkReferenceDepthEstimator, WindowRadius),
    RANGE(vtkSilhouetteReconciler, MinOffset),
    RANGE(vtkSilhouetteReconciler, MinShare),
    RANGE(vtkTextureAtlasGenerator, FeatherWidth),
    RANGE(vtkTextureAtlasGenerator, OcclusionSoftness),
    RANGE(vtkTextureAtlasGenerator, Power),
    RANGE(vtkTextureAtlasGenerator, References),
    RANGE(vtkTextureAtlasGenerator, TextureSize),
    SWITCH(vtkTextureAtlasGenerator, UseExposureGains),
    RANGE_OF(vtkTsdfDeformer, vtkTsdfOutlineDeformer, DepthNoise),
    RANGE(vtkTsdfOutlineDeformer, SilhouettePrior),
    SWITCH(vtkTsdfOutlineDeformer, UseContourPrediction),
    RANGE_OF(vtkViewDeformer, vtkOutlineDeformer, NumberOfIterations),
    RANGE(vtkViewDependentTextureMapper, FarAngle),
    RANGE(vtkViewDependentTextureMapper, FeatherWidth),
    RANGE(vtkViewDependentTextureMapper, OcclusionSoftness),
    RANGE(vtkViewDependentTextureMapper, Power),
    RANGE(vtkViewDependentTextureMapper, References),
    RANGE(vtkViewDependentTextureMapper, BoundarySamples),
    SWITCH(vtkViewDependentTextureMapper, SoftBoundary),
    SWITCH(vtkViewDependentTextureMapper, UseDepthMaps),
    SWITCH(vtkViewDependentTextureMapper, UseExposureGains),
    RANGE(vtkVisibilityCuller, MaximumEdgeLength),
    RANGE(vtkVisibilityCuller, Tolerance),
    SWITCH(vtkVisualHullSource, KeepAllComponents),
    RANGE(vtkVisualHullSource, SampleSpacing),
  };
}

/** The comment in front of a place, in one line. */
std::string CommentBefore(const std::string& text, std::size_t place)
{
  const std::size_t begin = text.rfind("/**", place);
  const std::size_t end = text.find("*/", begin);
  EXPECT_LT(end, place);
  return std::regex_replace(
    text.substr(begin + 3, end - begin - 3), std::regex(R"(\s+(\*\s+)?)"), " ");
}

/** What the comment of a setter says; NaN where it says nothing. */
Setter Documented(const std::string& comment, bool isSwitch)
{
  std::smatch found;
  if (isSwitch)
  {
    const bool says = std::regex_search(comment, found, std::regex(R"(Default (on|off)\.)"));
    return { says ? (found[1] == "on" ? 1.0 : 0.0) : std::nan("") };
  }
  const std::string number = R"(([-+.e\d]+))";
  if (!std::regex_search(comment, found,
        std::regex("Default " + number + R"(( \([^)]*\))?, range )" + number + " to " + number)))
  {
    return { std::nan("") };
  }
  // A full stop may follow the last number.
  return { std::stod(found[1]), std::stod(found[3]), std::stod(found[4]) };
}

/** The setters that the headers declare, with what their comments say. */
Setters InHeaders()
{
  Setters setters;
  const std::regex macro(
    R"(vtk(?:Set|SetClamp|FilterOption|(FilterSwitch))Macro\(\s*(\w+),\s*(\w+))");
  for (const auto& entry :
    std::filesystem::directory_iterator(std::filesystem::path(NOVELVIEW_SOURCE_DIR) / "vtkfilters"))
  {
    const std::string name = entry.path().stem().string();
    if (!name.starts_with("vtk") || entry.path().extension() != ".h")
    {
      continue;
    }
    std::ifstream file(entry.path());
    const std::string text{ std::istreambuf_iterator<char>(file), {} };
    for (std::sregex_iterator each(text.begin(), text.end(), macro), end; each != end; ++each)
    {
      const std::string setter = (*each)[2];
      if (setter != "OutputType") // of names
      {
        setters[name + "::" + setter] =
          Documented(CommentBefore(text, static_cast<std::size_t>(each->position())),
            (*each)[1].matched || (*each)[3] == "bool");
      }
    }
  }
  return setters;
}
}

TEST(Parameters, HeadersSayTheDefaultsAndRangesThatFiltersHave)
{
  const Setters compiled = Compiled();
  const Setters documented = InHeaders();
  for (const auto& [name, says] : documented)
  {
    SCOPED_TRACE(name);
    const auto found = compiled.find(name);
    ASSERT_NE(found, compiled.end()) << "is new: name it in Compiled()";
    EXPECT_EQ(says.Default, found->second.Default);
    EXPECT_EQ(says.Min, found->second.Min);
    EXPECT_EQ(says.Max, found->second.Max);
  }
  EXPECT_EQ(documented.size(), compiled.size());
}
