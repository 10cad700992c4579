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

#include <set>

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
  EXPECT_EQ(notWritten, std::set<std::string>{ "threads" }) << "which change no result";
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
  [[maybe_unused]] const auto& [m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15,
    m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26] = options;
  EXPECT_EQ(OptionsOf(options).size(), 26u);
}
