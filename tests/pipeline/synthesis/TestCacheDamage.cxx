// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever happens to a cache's file, the picture is right. NOVELVIEW_CACHE_DAMAGES sets how many
// random damages are tried.
#include "support/CacheScene.h"
#include "synthesis/CacheFile.h"
#include "synthesis/DataBytes.h"

#include <functional>
#include <random>

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

namespace
{
int Damages()
{
  const char* number = std::getenv("NOVELVIEW_CACHE_DAMAGES");
  return number ? std::stoi(number) : 300;
}

/** Changes bytes at random in one of many ways; the same ways for the same seed. */
class Vandal
{
public:
  explicit Vandal(unsigned int seed)
    : Numbers(seed)
  {
  }

  std::string Damaged(std::string bytes)
  {
    const std::size_t at = this->Place(bytes);
    const std::size_t length = std::min(bytes.size() - at, this->Below(100) + 1);
    switch (this->Below(9))
    {
      case 0:
        bytes[at] ^= static_cast<char>(1 << this->Below(8));
        break;
      case 1:
        bytes[at] = static_cast<char>(this->Below(256));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes += std::string(length, static_cast<char>(this->Below(256)));
        break;
      case 4:
        bytes.erase(at, length);
        break;
      case 5:
        bytes.insert(at, std::string(length, static_cast<char>(this->Below(256))));
        break;
      case 6: // a sector that was never written
        bytes.replace(at, std::min<std::size_t>(bytes.size() - at, 512),
          std::min<std::size_t>(bytes.size() - at, 512), '\0');
        break;
      case 7: // a large number
        bytes.replace(at, std::min<std::size_t>(bytes.size() - at, 8),
          std::min<std::size_t>(bytes.size() - at, 8), '\xff');
        break;
      default:
        for (std::size_t i = 0; i < length; ++i)
        {
          bytes[at + i] = static_cast<char>(this->Below(256));
        }
    }
    return bytes;
  }

  std::size_t Below(std::size_t count) { return this->Numbers() % count; }

private:
  /** Half of the time near the front, where the lengths are. */
  std::size_t Place(const std::string& bytes)
  {
    return this->Below(this->Below(2) ? bytes.size() : std::min<std::size_t>(bytes.size(), 1500));
  }

  std::mt19937_64 Numbers;
};

using CacheDamage = CacheTest;
}

TEST_F(CacheDamage, EveryPictureIsRight)
{
  const Outcome right = Synthesise(this->Options, this->Views);
  const fs::path entry = this->OnlyEntry();
  const std::string good = ReadText(entry);
  StageCache cache(this->Options.Cache, this->Views, this->Options);
  Vandal vandal(1);
  for (int i = 0; i < Damages(); ++i)
  {
    const std::string damaged = vandal.Damaged(good);
    WriteText(entry, damaged);
    // What is not taken from the cache is computed, so that the picture follows from this.
    ASSERT_EQ(cache.Load().has_value(), damaged == good) << "damage " << i;
    ASSERT_EQ(cache.Damage().empty(), damaged == good) << "damage " << i;
    ASSERT_THAT(cache.Damage(), testing::Not(testing::HasSubstr("\n"))) << "damage " << i;
    // Some of the pictures are looked at all the same; each takes a whole synthesis.
    if (i % 25 == 0)
    {
      const Outcome outcome = Synthesise(this->Options, this->Views);
      ASSERT_EQ(outcome.Color, right.Color) << "damage " << i;
      ASSERT_EQ(outcome.Warnings.size(), right.Warnings.size() + (damaged != good))
        << "damage " << i << ": " << testing::PrintToString(outcome.Warnings);
      ASSERT_TRUE(ReadText(entry) == good) << "damage " << i << " is not mended";
    }
  }
}

TEST_F(CacheDamage, BytesWithARightChecksumAreReadSafely)
{
  Synthesise(this->Options, this->Views);
  const auto kept = StageCache(this->Options.Cache, this->Views, this->Options).Load();
  ASSERT_TRUE(kept);
  const std::string mesh = PackedMesh(kept->Crust);
  const std::string balls = PackedMesh(kept->MedialBalls);
  const std::string image = PackedImage(ViewImage(kept->Views, 0));
  Vandal vandal(2);
  int refused = 0;
  for (int i = 0; i < Damages(); ++i)
  {
    try
    {
      switch (i % 3)
      {
        case 0:
          UnpackedMesh(vandal.Damaged(mesh), "mesh")->GetBounds();
          break;
        case 1:
          UnpackedMesh(vandal.Damaged(balls), "balls")->GetBounds();
          break;
        default:
          UnpackedImage(vandal.Damaged(image), "image");
      }
    }
    catch (const Error&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, Damages() / 10) << "lengths and types are damaged that often at least";
}

TEST_F(CacheDamage, ADirectoryWithARightChecksumIsReadSafely)
{
  const fs::path path = this->Folder / "some.nvcache";
  WriteText(path, ComposeCacheFile("key", { { "a", "bytes" }, { "b", "" }, { "a", "others" } }));
  const CacheFile file(path, "key");
  EXPECT_EQ(file.Read("a"), "bytes");
  EXPECT_EQ(file.Read("b"), "");
  support::ExpectError([&] { file.Read("c"); }, "has no c");
  support::ExpectError([&] { CacheFile(path, "kex"); }, "something else");
  WriteText(path, ComposeCacheFile("key", {}));
  support::ExpectError([&] { CacheFile(path, "key").Read("a"); }, "has no a");
}
