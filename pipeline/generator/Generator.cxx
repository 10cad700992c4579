// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/Generator.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "base/JsonFile.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "drawing/ScenePictures.h"
#include "generator/GeneratorRig.h"
#include "generator/SyntheticRenderer.h"
#include "images/ImageFile.h"
#include "mesh/ObjectMesh.h"
#include "mesh/PolyDataFile.h"

#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vtkNew.h>

#include <algorithm>
#include <cstdio>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** A pixel brighter than this belongs to the object in masks of the kind "threshold". */
constexpr int MaskThreshold = 24;

bool Contains(const std::vector<int>& viewIds, int viewId)
{
  return std::find(viewIds.begin(), viewIds.end(), viewId) != viewIds.end();
}

/** The pixels as OpenCV sees them; nothing is copied. */
cv::Mat Wrap(Image<std::uint8_t>& image)
{
  return cv::Mat(image.Height, image.Width, CV_8UC(image.Channels), image.Values.data());
}

/** Darkens towards the corners, in which `share` of the brightness is missing. */
void Vignette(cv::Mat& pixels, double share)
{
  const double cx = (pixels.cols - 1) / 2.0;
  const double cy = (pixels.rows - 1) / 2.0;
  for (int y = 0; y < pixels.rows; ++y)
  {
    for (int x = 0; x < pixels.cols; ++x)
    {
      const double fromCentre = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (cx * cx + cy * cy);
      pixels.at<cv::Vec3f>(y, x) *= static_cast<float>(1 - share * fromCentre);
    }
  }
}

/** Lens and sensor of one photograph: blur, vignetting, gain, noise. */
void SpoilColors(Image<std::uint8_t>& color, const GeneratorOptions& options, int viewId)
{
  if (options.GainSpread == 0 && options.NoiseSigma == 0 && options.DefocusPx == 0 &&
    options.Vignetting == 0)
  {
    return;
  }
  cv::RNG random((static_cast<std::uint64_t>(options.Seed) << 32) + 7919u * viewId + 1);
  random.next(); // neighbouring seeds give neighbouring first numbers
  const double gain = random.uniform(1 - options.GainSpread, 1 + options.GainSpread);
  cv::Mat pixels = Wrap(color);
  cv::Mat spoilt;
  pixels.convertTo(spoilt, CV_32FC3, gain);
  if (options.DefocusPx > 0)
  {
    cv::GaussianBlur(spoilt, spoilt, cv::Size(), options.DefocusPx, 0, cv::BORDER_REPLICATE);
  }
  if (options.Vignetting > 0)
  {
    Vignette(spoilt, options.Vignetting);
  }
  cv::Mat noise(spoilt.size(), CV_32FC3);
  random.fill(noise, cv::RNG::NORMAL, 0.0, options.NoiseSigma);
  spoilt += noise;
  spoilt.convertTo(pixels, CV_8UC3);
}

/** What is left of the pixels in a JPEG file. */
void CompressAsJpeg(Image<std::uint8_t>& color, int quality)
{
  cv::Mat pixels = Wrap(color);
  cv::Mat bgr;
  cv::cvtColor(pixels, bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> file;
  cv::imencode(".jpg", bgr, file, { cv::IMWRITE_JPEG_QUALITY, quality });
  cv::cvtColor(cv::imdecode(file, cv::IMREAD_COLOR), pixels, cv::COLOR_BGR2RGB);
}

/**
 * Shrinks (or grows, when negative) by a disc of this radius; coverage stays grey at the silhouette
 * boundary.
 */
void ErodeMask(Image<std::uint8_t>& mask, int radiusPx)
{
  const int side = 2 * std::abs(radiusPx) + 1;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(side, side));
  cv::Mat pixels = Wrap(mask);
  if (radiusPx > 0)
  {
    cv::erode(pixels, pixels, disc);
  }
  else
  {
    cv::dilate(pixels, pixels, disc);
  }
}

Image<std::uint8_t> ThresholdedMask(const Image<std::uint8_t>& color)
{
  Image<std::uint8_t> mask(color.Width, color.Height);
  for (int y = 0; y < color.Height; ++y)
  {
    for (int x = 0; x < color.Width; ++x)
    {
      const int brightest = std::max({ color(x, y, 0), color(x, y, 1), color(x, y, 2) });
      mask(x, y) = brightest > MaskThreshold ? 255 : 0;
    }
  }
  return mask;
}

/** Photograph and mask of one view, with the requested imperfections. */
RenderedPhotograph TakeView(SyntheticRenderer& photographer, const Camera& camera,
  const GeneratorOptions& options, int viewId)
{
  const double shadow = Contains(options.ShadowViews, viewId) ? options.ShadowDarkness : 0;
  RenderedPhotograph photograph = photographer.Take(camera, shadow);
  SpoilColors(photograph.Color, options, viewId);
  if (options.JpegQuality > 0)
  {
    CompressAsJpeg(photograph.Color, options.JpegQuality);
  }
  if (options.Masks == "threshold")
  {
    photograph.Coverage = ThresholdedMask(photograph.Color);
  }
  const bool erode = options.MaskErodeViews.empty() || Contains(options.MaskErodeViews, viewId);
  if (options.MaskErodePx != 0 && erode)
  {
    ErodeMask(photograph.Coverage, options.MaskErodePx);
  }
  return photograph;
}

SurfaceLook LookOf(const GeneratorOptions& options)
{
  return { options.Texture, options.Lit, options.Seed, options.Light == "rig", options.Gloss,
    options.Exposure };
}

/** One camera with the name of its picture. */
struct Shot
{
  std::string Name;
  Camera Cam;
};

void AppendMatrix(std::string& line, const Eigen::Ref<const Eigen::MatrixXd>& matrix)
{
  for (int row = 0; row < matrix.rows(); ++row)
  {
    for (int column = 0; column < matrix.cols(); ++column)
    {
      // Adding zero makes -0, which only confuses a reader, a plain 0.
      line += Formatted(" %.17g", matrix(row, column) + 0.0);
    }
  }
}

void WriteCalibration(const fs::path& path, const std::vector<Shot>& cameras)
{
  std::string text = std::to_string(cameras.size()) + "\n";
  for (const Shot& camera : cameras)
  {
    text += camera.Name;
    AppendMatrix(text, camera.Cam.K);
    AppendMatrix(text, camera.Cam.R);
    AppendMatrix(text, camera.Cam.T);
    text += "\n";
  }
  WriteTextAtomically(path, text);
}

std::string PictureName(const std::string& stem, std::size_t id)
{
  char digits[24];
  std::snprintf(digits, sizeof digits, "%04zu", id);
  return stem + digits + ".png";
}

std::string OptionsText(const GeneratorOptions& options)
{
  const nlohmann::ordered_json json = { { "mesh", options.Mesh.empty() ? "bunny" : options.Mesh },
    { "texture", options.Texture }, { "lit", options.Lit }, { "light", options.Light },
    { "gloss", options.Gloss }, { "exposure", options.Exposure }, { "seed", options.Seed },
    { "views", options.Views }, { "step", options.StepDeg }, { "elevation", options.ElevationDeg },
    { "second_ring", options.SecondRingDeg }, { "size", { options.Width, options.Height } },
    { "field_of_view", options.FieldOfViewDeg }, { "fill", options.Fill },
    { "supersampling", options.Supersampling }, { "test_angles", options.TestAnglesDeg },
    { "gain_spread", options.GainSpread }, { "noise_sigma", options.NoiseSigma },
    { "calibration_noise", options.CalibrationNoisePx },
    { "principal_noise", options.PrincipalNoisePx }, { "focal_noise", options.FocalNoise },
    { "defocus", options.DefocusPx }, { "vignetting", options.Vignetting },
    { "jpeg", options.JpegQuality }, { "mask_erode", options.MaskErodePx },
    { "mask_erode_views", options.MaskErodeViews }, { "frame_shift", options.FrameShift },
    { "frame_shift_views", options.FrameShiftViews }, { "shadow_views", options.ShadowViews },
    { "shadow_darkness", options.ShadowDarkness }, { "masks", options.Masks } };
  return DumpJson(json) + "\n";
}

/** Where the images of one list of cameras go and what becomes of each. */
void WriteHeldOut(SyntheticRenderer& photographer, const std::vector<Camera>& cameras,
  const fs::path& folder, const std::function<void()>& step)
{
  std::vector<Shot> named;
  for (const Camera& camera : cameras)
  {
    const std::string name = PictureName("test", named.size());
    const RenderedPhotograph photograph = photographer.Take(camera);
    WriteImageFile(folder / name, photograph.Color.Ref());
    WriteImageFile(folder / "mask" / name, photograph.Coverage.Ref());
    named.push_back({ name, camera });
    step();
  }
  WriteCalibration(folder / "test_par.txt", named);
}

/** The photograph for the overview (by value, since OpenCV wraps no const pixels). */
vtkSmartPointer<vtkImageData> Thumbnail(Image<std::uint8_t> color)
{
  cv::Mat small;
  const double scale = std::min(1.0, 400.0 / color.Width);
  cv::resize(Wrap(color), small, cv::Size(), scale, scale, cv::INTER_AREA);
  vtkSmartPointer<vtkImageData> image = NewImage(small.cols, small.rows);
  const auto out = AddTopDownArray<std::uint8_t>(image, arrays::Color, 3);
  for (int y = 0; y < small.rows; ++y)
  {
    std::copy_n(small.ptr<std::uint8_t>(y), 3 * small.cols, out.Row(y));
  }
  return image;
}

/** Returns the photographs for the overview. */
std::vector<vtkSmartPointer<vtkImageData>> WriteViews(SyntheticRenderer& photographer,
  const Rig& rig, const GeneratorOptions& options, const fs::path& folder,
  const std::function<void()>& step)
{
  const std::string stem = ObjectName(options.Mesh);
  std::vector<Shot> named;
  std::vector<vtkSmartPointer<vtkImageData>> thumbnails;
  for (int viewId = 0; viewId < options.Views; ++viewId)
  {
    const std::string name = PictureName(stem, viewId);
    const RenderedPhotograph photograph =
      TakeView(photographer, rig.Views[viewId], options, viewId);
    WriteImageFile(folder / name, photograph.Color.Ref());
    if (options.Masks != "none")
    {
      WriteImageFile(folder / "mask" / name, photograph.Coverage.Ref());
    }
    named.push_back({ name, rig.Written[viewId] });
    thumbnails.push_back(Thumbnail(photograph.Color));
    step();
  }
  WriteCalibration(folder / (stem + "_par.txt"), named);
  return thumbnails;
}

/** Every file of the data set, in its folder. */
std::vector<fs::path> FilesOfDataset(const GeneratorOptions& options)
{
  const std::string stem = ObjectName(options.Mesh);
  std::vector<fs::path> files{ "truth.ply", "overview.png", "generate.json", stem + "_par.txt" };
  const auto addPictures = [&files](
                             const fs::path& folder, const std::string& name, std::size_t count)
  {
    for (std::size_t id = 0; id < count; ++id)
    {
      files.push_back(folder / PictureName(name, id));
      files.push_back(folder / "mask" / PictureName(name, id));
    }
  };
  addPictures("", stem, static_cast<std::size_t>(options.Views));
  if (!options.TestAnglesDeg.empty())
  {
    addPictures("test", "test", options.TestAnglesDeg.size());
    files.emplace_back("test/test_par.txt");
  }
  return files;
}

void WriteOverview(const fs::path& path, vtkPolyData* mesh, const Rig& rig,
  const GeneratorOptions& options, std::vector<vtkSmartPointer<vtkImageData>> photographs)
{
  RigPicture picture;
  picture.Title = ObjectName(options.Mesh) + ", " + options.Texture + ", photographs of " +
    SizeText(options.Width, options.Height);
  picture.Mesh = mesh;
  picture.Look = LookOf(options);
  picture.Views = rig.Views;
  picture.Photographs = std::move(photographs);
  picture.HeldOut = rig.Tests;
  for (const double angleDeg : options.TestAnglesDeg)
  {
    picture.HeldOutLabels.push_back(Formatted("%g\xC2\xB0", angleDeg)); // the degree sign
  }
  DrawRig(picture, path);
}
}

//------------------------------------------------------------------------------
void GenerateDataset(
  const GeneratorOptions& options, const fs::path& out, const GeneratorProgress& progress)
{
  ValidateGeneratorOptions(options);
  double done = 0;
  const double all = options.Views + options.TestAnglesDeg.size() + 3.0;
  const auto report = [&](const std::string& what, double steps)
  {
    done += steps;
    if (progress && !progress(what, done / all))
    {
      throw Interrupted();
    }
  };

  for (const fs::path& file : FilesOfDataset(options))
  {
    AnnounceOutput(out / file);
  }
  report("object", 0);
  vtkSmartPointer<vtkPolyData> mesh = LoadObject(options.Mesh);
  const Rig rig = MakeRig(mesh, options);
  RequireWritable(out);
  SyntheticRenderer photographer(mesh, LookOf(options), options.Supersampling);
  WritePly(out / "truth.ply", mesh);
  report("photographs", 2);
  const auto photographs =
    WriteViews(photographer, rig, options, out, [&] { report("photographs", 1); });
  if (!rig.Tests.empty())
  {
    WriteHeldOut(photographer, rig.Tests, out / "test", [&] { report("held-out views", 1); });
  }
  WriteOverview(out / "overview.png", mesh, rig, options, photographs);
  WriteTextAtomically(out / "generate.json", OptionsText(options));
  report("done", 1);
}
}
