// SPDX-License-Identifier: GPL-3.0-or-later
// No option is forgotten: each has a row, and job files hold each that can change a result.
#include "base/JsonFile.h"
#include "commands/EvaluateOptions.h"
#include "commands/MeshOptions.h"
#include "commands/OrbitOptions.h"
#include "commands/RenderOptions.h"
#include "commands/RunOptions.h"
#include "support/ChangedOption.h"
#include "support/TestSupport.h"

#include <functional>
#include <initializer_list>
#include <set>
#include <type_traits>
#include <utility>
#include <variant>

using namespace novelview;
using namespace novelview::testing_support;
using Json = nlohmann::ordered_json;

namespace
{
template <class Options>
class JobOptions : public testing::Test
{
};
using CommandsWithJobs =
  testing::Types<RunOptions, RenderOptions, OrbitOptions, MeshOptions, EvaluateOptions>;
TYPED_TEST_SUITE(JobOptions, CommandsWithJobs);
}

TYPED_TEST(JobOptions, EveryOptionOfAJobIsReadBackAsItWasWritten)
{
  const TemporaryFolder folder;
  TypeParam options;
  TypeParam readBack;
  const OptionTable table = OptionsOf(options);
  const OptionTable tableBack = OptionsOf(readBack);
  const Json defaults = ToJson(table, folder.Path);
  for (const Option& option : table)
  {
    support::ChangeValue(option);
  }
  const Json written = ToJson(table, folder.Path);
  SetFromJson(tableBack, ParseJson(DumpJson(written), "job"), folder.Path, "job");
  const Json again = ToJson(tableBack, folder.Path);
  std::set<std::string> notWritten;
  for (const Option& option : table)
  {
    SCOPED_TRACE(option.Key);
    if (!option.InJob)
    {
      notWritten.insert(option.Key);
      EXPECT_FALSE(written.contains(option.Key));
      continue;
    }
    ASSERT_TRUE(written.contains(option.Key));
    EXPECT_NE(written[option.Key], defaults[option.Key]);
    EXPECT_EQ(again[option.Key], written[option.Key]);
  }
  notWritten.erase("rankTimeout"); // of the commands that processes share
  EXPECT_EQ(notWritten, (std::set<std::string>{ "renderer", "threads" }))
    << "which change no result";
}

TEST(RunJob, HoldsEveryOptionThatCanChangeTheResult)
{
  RunOptions options;
  options.Out = "out";
  const Json job = ParseJson(JobText(options), "job.json");
  for (const Option& option : OptionsOf(options))
  {
    EXPECT_EQ(job.contains(option.Key), option.InJob) << option.Key;
  }
}

TEST(SynthesisOptionTable, HasARowForEveryMember)
{
  SynthesisOptions options;
  // As many names as there are members; with another number it does not compile.
  const auto& [preset, cache, refineCameras, reconcile, repair, hull, culler, outline, nonOutline,
    texture, useDepthMaps, depthMaps] = options;
  // Every member has a row, or rows for some of its own members.
  std::size_t rows = 0;
  for (const auto& [member, size] :
    std::initializer_list<std::pair<const void*, std::size_t>>{ { &preset, sizeof(preset) },
      { &cache, sizeof(cache) }, { &refineCameras, sizeof(refineCameras) },
      { &reconcile, sizeof(reconcile) }, { &repair, sizeof(repair) }, { &hull, sizeof(hull) },
      { &culler, sizeof(culler) }, { &outline, sizeof(outline) },
      { &nonOutline, sizeof(nonOutline) }, { &texture, sizeof(texture) },
      { &useDepthMaps, sizeof(useDepthMaps) }, { &depthMaps, sizeof(depthMaps) } })
  {
    const auto* begin = static_cast<const char*>(member);
    const std::size_t before = rows;
    for (const Option& option : OptionsOf(options))
    {
      const void* value = std::visit(
        [](const auto& target) -> const void*
        {
          if constexpr (std::is_pointer_v<std::decay_t<decltype(target)>>)
          {
            return target;
          }
          return nullptr;
        },
        option.Target);
      rows += std::less_equal<const char*>()(begin, static_cast<const char*>(value)) &&
        std::less<const char*>()(static_cast<const char*>(value), begin + size);
    }
    EXPECT_GT(rows, before);
  }
  EXPECT_EQ(rows, OptionsOf(options).size());
  EXPECT_EQ(rows, 27u);
}
