// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/BouguetCalibration.h"

#include "base/InputFile.h"
#include "base/NumberText.h"
#include "cameras/CameraLimits.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"
#include "formats/WriteChecks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr std::size_t MaxCoefficients = 5;

/** The right side of an assignment. */
struct Assigned
{
  std::vector<double> Numbers;
  std::string Text; ///< between quotes
  std::string Where;
};
using Script = std::map<std::string, Assigned>;

std::string Stripped(const std::string& text)
{
  const std::vector<std::string> words = Words(text);
  return Joined(words, " ");
}

/** "NaN" in any case, which std::from_chars also reads, but not with MATLAB's sign. */
bool ParseMatlab(const std::string& word, double& number)
{
  if (word == "NaN" || word == "-NaN")
  {
    number = std::nan("");
    return true;
  }
  return ParseNumber(word, number);
}

/** `name = value;` of a line; false when the line is no assignment of numbers or a text. */
bool ParseAssignment(const std::string& line, std::string& name, Assigned& assigned)
{
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos)
  {
    return false;
  }
  name = Stripped(line.substr(0, equals));
  std::string value = line.substr(equals + 1);
  if (const std::size_t quote = value.find('\''); quote < value.find('%'))
  {
    const std::size_t end = value.find('\'', quote + 1);
    assigned.Text = value.substr(quote + 1, end == std::string::npos ? end : end - quote - 1);
    return true;
  }
  value = value.substr(0, value.find('%'));
  std::replace_if(
    value.begin(), value.end(), [](char c) { return c == '[' || c == ']' || c == ';' || c == ','; },
    ' ');
  for (const std::string& word : Words(value))
  {
    double number = 0;
    if (!ParseMatlab(word, number))
    {
      return false;
    }
    assigned.Numbers.push_back(number);
  }
  return !assigned.Numbers.empty();
}

Script ReadScript(const fs::path& path)
{
  std::istringstream file(ReadInputText(path));
  Script script;
  int lineNumber = 0;
  for (std::string line; std::getline(file, line);)
  {
    Assigned assigned;
    assigned.Where = path.string() + ", line " + std::to_string(++lineNumber);
    std::string name;
    if (line.find_first_not_of(" \t") != line.find('%') && ParseAssignment(line, name, assigned))
    {
      script[name] = assigned;
    }
  }
  return script;
}

const std::vector<double>& Needed(
  const Script& script, std::string_view nameView, std::size_t count, const fs::path& path)
{
  const std::string name(nameView);
  const auto found = script.find(name);
  if (found == script.end() || found->second.Numbers.size() != count)
  {
    throw Error(found == script.end() ? path.string() : found->second.Where,
      "no " + name + " of the right length",
      found == script.end() ? "none" : std::to_string(found->second.Numbers.size()) + " numbers",
      std::to_string(count));
  }
  return found->second.Numbers;
}

std::string TextOf(const Script& script, const std::string& name)
{
  const auto found = script.find(name);
  return found == script.end() ? "" : found->second.Text;
}

/** What all photographs share. */
Photograph IntrinsicsOf(const Script& script, const fs::path& path)
{
  const std::vector<double>& fc = Needed(script, "fc", 2, path);
  const std::vector<double>& cc = Needed(script, "cc", 2, path);
  Photograph photograph;
  Eigen::Matrix3d& K = photograph.Cam.K;
  K << fc[0], 0, cc[0], 0, fc[1], cc[1], 0, 0, 1;
  if (script.count("alpha_c"))
  {
    K(0, 1) = Needed(script, "alpha_c", 1, path)[0] * fc[0];
  }
  if (const auto kc = script.find("kc"); kc != script.end())
  {
    if (kc->second.Numbers.size() > MaxCoefficients)
    {
      throw Error(kc->second.Where, "too many distortion coefficients",
        std::to_string(kc->second.Numbers.size()), "at most 5: k1 k2 p1 p2 k3");
    }
    photograph.Distortion.Coefficients = kc->second.Numbers;
  }
  photograph.Cam.Width = ExtentOf(Needed(script, "nx", 1, path)[0], "nx", path.string());
  photograph.Cam.Height = ExtentOf(Needed(script, "ny", 1, path)[0], "ny", path.string());
  return photograph;
}

/** The numbers N for which there is an omc_N, rising. */
std::vector<int> ImageNumbers(const Script& script)
{
  std::vector<int> numbers;
  for (const auto& [name, assigned] : script)
  {
    int number = 0;
    if (name.starts_with("omc_") && ParseNumber(name.substr(4), number))
    {
      numbers.push_back(number);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/** The file in the folder that is named NAMEn.FORMAT, with any number of leading zeros. */
std::string NumberedName(
  const std::string& base, int number, const std::string& format, const fs::path& folder)
{
  std::error_code failure;
  std::string digits = std::to_string(number);
  for (int zeros = 0; zeros < 8; ++zeros)
  {
    std::string name = base + digits + "." + format;
    if (fs::is_regular_file(folder / name, failure))
    {
      return name;
    }
    digits = "0" + digits;
  }
  return base + std::to_string(number) + "." + format;
}

/** The photographs' names, one for each number. */
std::vector<std::string> NamesOf(const Script& script, const std::vector<int>& numbers,
  const fs::path& folder, const fs::path& path)
{
  std::vector<std::string> names;
  const std::string base = TextOf(script, "calib_name");
  const std::string format = TextOf(script, "format_image");
  for (const int number : numbers)
  {
    const std::string own = TextOf(script, "image_name_" + std::to_string(number));
    if (!own.empty() || !format.empty())
    {
      names.push_back(own.empty() ? NumberedName(base, number, format, folder) : own);
    }
  }
  if (names.empty())
  {
    names = PhotographsIn(folder);
  }
  if (names.size() != numbers.size())
  {
    throw Error(path.string(), "not as many photographs as images in the calibration",
      std::to_string(names.size()), std::to_string(numbers.size()));
  }
  return names;
}

Eigen::Matrix3d RotationOf(const std::vector<double>& omc)
{
  const Eigen::Vector3d vector(omc[0], omc[1], omc[2]);
  const double angle = vector.norm();
  return angle == 0 ? Eigen::Matrix3d::Identity()
                    : Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

Calibration ReadBouguet(const fs::path& folder, const fs::path& path)
{
  const Script script = ReadScript(path);
  const Photograph shared = IntrinsicsOf(script, path);
  const std::vector<int> numbers = ImageNumbers(script);
  const std::vector<std::string> names = NamesOf(script, numbers, folder, path);
  Calibration calibration;
  calibration.Convention = ProjectConvention();
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const std::string omcName = "omc_" + std::to_string(numbers[i]);
    const std::vector<double>& omc = Needed(script, omcName, 3, path);
    const std::vector<double>& tc = Needed(script, "Tc_" + std::to_string(numbers[i]), 3, path);
    if (std::any_of(omc.begin(), omc.end(), [](double number) { return std::isnan(number); }))
    {
      continue;
    }
    Photograph photograph = shared;
    photograph.Name = names[i];
    photograph.File = folder / names[i];
    photograph.Where = script.at(omcName).Where + " (" + names[i] + ")";
    photograph.Cam.R = RotationOf(omc);
    photograph.Cam.T = Eigen::Map<const Eigen::Vector3d>(tc.data());
    calibration.Photographs.push_back(photograph);
  }
  return calibration;
}

/** [ a ; b ; .. ] */
std::string ColumnText(const std::vector<double>& numbers)
{
  std::vector<std::string> words;
  for (const double number : numbers)
  {
    words.push_back(NumberText(number));
  }
  return "[ " + Joined(words, " ; ") + " ]";
}

/** Throws where photographs do not share what the format has only once. */
void CheckShared(const std::vector<Photograph>& photographs)
{
  const Photograph& first = photographs.front();
  for (const Photograph& photograph : photographs)
  {
    const char* what = nullptr;
    if (photograph.Cam.K != first.Cam.K)
    {
      what = "K";
    }
    else if (photograph.Cam.Width != first.Cam.Width || photograph.Cam.Height != first.Cam.Height)
    {
      what = "size";
    }
    else if (Trimmed(photograph.Distortion) != Trimmed(first.Distortion))
    {
      what = "distortion";
    }
    if (what)
    {
      throw Error("view " + photograph.Name,
        std::string("the format bouguet has one ") + what + " for all photographs, and " +
          first.Name + " has another");
    }
    if (photograph.Name.find_first_of("'\r\n") != std::string::npos)
    {
      throw Error(
        "view " + photograph.Name, "a name with a quote or a line break cannot be written");
    }
  }
}

std::vector<FileContent> ComposeBouguet(
  const std::string&, const std::vector<Photograph>& photographs)
{
  CheckShared(photographs);
  const Camera& camera = photographs.front().Cam;
  std::vector<double> kc = Trimmed(photographs.front().Distortion).Coefficients;
  kc.resize(MaxCoefficients, 0);
  const Eigen::Matrix3d& K = camera.K;
  std::string text = "% Intrinsic and Extrinsic Camera Parameters\n\n";
  text += "fc = " + ColumnText({ K(0, 0), K(1, 1) }) + ";\n";
  text += "cc = " + ColumnText({ K(0, 2), K(1, 2) }) + ";\n";
  text += "alpha_c = " + NumberText(K(0, 1) / K(0, 0)) + ";\n";
  text += "kc = " + ColumnText(kc) + ";\n";
  text += "nx = " + std::to_string(camera.Width) + ";\n";
  text += "ny = " + std::to_string(camera.Height) + ";\n";
  text += "n_ima = " + std::to_string(photographs.size()) + ";\n";
  int number = 0;
  for (const Photograph& photograph : photographs)
  {
    const std::string index = std::to_string(++number);
    const Eigen::AngleAxisd turn(NearestRotation(photograph.Cam.R));
    const Eigen::Vector3d omc = turn.angle() * turn.axis();
    const Eigen::Vector3d& t = photograph.Cam.T;
    text += "\n%-- Image #" + index + ":\n";
    text += "image_name_" + index + " = '" + photograph.Name + "';\n";
    text += "omc_" + index + " = " + ColumnText({ omc.x(), omc.y(), omc.z() }) + ";\n";
    text += "Tc_" + index + " = " + ColumnText({ t.x(), t.y(), t.z() }) + ";\n";
  }
  return { { "Calib_Results.m", text } };
}
}

DatasetFormat BouguetFormat()
{
  DatasetFormat format;
  format.Name = "bouguet";
  format.LookedFor = "Calib_Results.m";
  format.Find = [](const fs::path& folder)
  {
    std::error_code failure;
    const fs::path file = FileOfAnyCase(folder / "Calib_Results.m");
    return fs::is_regular_file(file, failure) ? std::vector{ file } : std::vector<fs::path>();
  };
  format.Accepts = [](const fs::path& path) { return path.extension() == ".m"; };
  format.Read = ReadBouguet;
  format.MaskFolder = "mask";
  format.MaskName = [](const std::string& name)
  { return fs::path(name).replace_extension(".png").string(); };
  format.HoldsLens = [](const Photograph& photograph)
  {
    return photograph.Distortion.Kind == Lens::Model::Perspective &&
      Trimmed(photograph.Distortion).Coefficients.size() <= MaxCoefficients;
  };
  format.Compose = ComposeBouguet;
  return format;
}
}
