// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/ForeignCalibrations.h"

#include "base/InputFile.h"
#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** A kind of file that is not read. */
struct ForeignKind
{
  std::function<bool(const std::string& name, const std::string& head)> Is; ///< name in lower case
  const char* Text; ///< what it is; the way out
};

bool EndsWith(const std::string& name, std::initializer_list<const char*> endings)
{
  for (const char* ending : endings)
  {
    if (name.ends_with(ending))
    {
      return true;
    }
  }
  return false;
}

bool Contains(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

const std::vector<ForeignKind>& ForeignKinds()
{
  static const std::vector<ForeignKind> kinds{
    { [](const std::string& name, const std::string&)
      { return name.ends_with(".sfm") || name == "sfm.json" || name == "sfm.abc"; },
      "a scene of AliceVision (Meshroom); aliceVision_exportColmap writes a COLMAP model" },
    { [](const std::string& name, const std::string& head)
      { return name.starts_with("sfm_data") || Contains(head, "\"sfm_data_version\""); },
      "a scene of OpenMVG; openMVG_main_openMVG2Colmap writes a COLMAP model" },
    { [](const std::string& name, const std::string& head)
      { return name.ends_with(".xml") && Contains(head, "<chunk"); },
      "a camera file of Metashape; export the cameras from Metashape in COLMAP's format" },
    { [](const std::string& name, const std::string&) { return name.ends_with(".psx"); },
      "a project of Metashape; export its cameras from Metashape in COLMAP's format" },
    { [](const std::string& name, const std::string& head)
      { return name.ends_with(".out") && Contains(head, "Bundle"); },
      "a scene of Bundler; colmap or meshlab convert it to COLMAP's format" },
    { [](const std::string& name, const std::string&) {
       return EndsWith(name, { ".nvm", ".rc" });
     },
      "a scene of VisualSFM or RealityCapture; export it in COLMAP's format" },
    { [](const std::string& name, const std::string&) {
       return EndsWith(name, { ".mp4", ".mov", ".avi", ".mkv", ".webm", ".m4v" });
     },
      "a video; take pictures from it (ffmpeg -i VIDEO -vf fps=2 images/%04d.png) and run COLMAP "
      "on "
      "them" },
    { [](const std::string& name, const std::string&) {
       return EndsWith(name, { ".heic", ".heif", ".avif" });
     },
      "a HEIC photograph; these are not read; heif-convert writes them as JPEG or PNG" },
    { [](const std::string& name, const std::string&) {
       return EndsWith(name, { ".cr2", ".cr3", ".nef", ".arw", ".dng", ".raf", ".orf", ".rw2" });
     },
      "one of raw photographs, which are not read; darktable-cli or dcraw write them as TIFF or "
      "PNG" },
  };
  return kinds;
}

bool IsOfKind(const fs::path& file, const ForeignKind& kind)
{
  constexpr std::size_t headBytes = 2048;
  const std::string name = LowerCase(file.filename().string());
  const bool text = EndsWith(name, { ".json", ".xml", ".out" });
  return kind.Is(name, text ? ReadInputStart(file, headBytes) : "");
}
}

std::string ForeignFile(const fs::path& file)
{
  for (const ForeignKind& kind : ForeignKinds())
  {
    if (IsOfKind(file, kind))
    {
      return file.filename().string() + " is " + kind.Text;
    }
  }
  return "";
}

std::string ForeignFilesIn(const fs::path& folder)
{
  std::vector<fs::path> files = FilesIn(folder);
  const std::vector<fs::path> photographs = FilesIn(folder / "images");
  files.insert(files.end(), photographs.begin(), photographs.end());
  // Calibrations come first: they are what is missing.
  for (const ForeignKind& kind : ForeignKinds())
  {
    const auto found = std::find_if(
      files.begin(), files.end(), [&kind](const fs::path& file) { return IsOfKind(file, kind); });
    if (found != files.end())
    {
      return found->filename().string() + " is " + kind.Text;
    }
  }
  return "";
}
}
