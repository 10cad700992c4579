// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/FrameRequest.h"

#include "core/Error.h"

#include <nlohmann/json.hpp>

namespace novelview
{
namespace
{
const char* const Where = "request";

/** A matrix of doubles, row by row. */
template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> MatrixOf(const nlohmann::json& json, const char* key)
{
  const auto values = json.find(key);
  if (values == json.end() || !values->is_array() || values->size() != Rows * Columns)
  {
    throw Error(Where, std::string(key) + " must be an array of numbers", "",
      std::to_string(Rows * Columns) + " numbers");
  }
  Eigen::Matrix<double, Rows, Columns> matrix;
  for (int i = 0; i < Rows * Columns; ++i)
  {
    const nlohmann::json& value = (*values)[i];
    if (!value.is_number())
    {
      throw Error(Where, std::string(key) + " contains something that is no number");
    }
    matrix(i / Columns, i % Columns) = value.get<double>();
  }
  return matrix;
}

int SideOf(const nlohmann::json& json, const char* key)
{
  const auto value = json.find(key);
  if (value == json.end() || !value->is_number_integer() || *value < 1 ||
    *value > FrameRequest::LargestSidePx)
  {
    throw Error(Where, std::string(key) + " is out of range", "",
      "1 to " + std::to_string(FrameRequest::LargestSidePx) + " px");
  }
  return value->get<int>();
}

FrameRequest::Picture ShowOf(const nlohmann::json& json)
{
  const auto show = json.find("show");
  if (show == json.end() || *show == "colour")
  {
    return FrameRequest::Picture::Colour;
  }
  if (*show != "depth" && *show != "mesh")
  {
    throw Error(Where, "show is unknown", "", "colour, depth or mesh");
  }
  return *show == "depth" ? FrameRequest::Picture::Depth : FrameRequest::Picture::Mesh;
}

std::optional<Eigen::Vector2i> PickOf(const nlohmann::json& json, const Camera& camera)
{
  const auto pick = json.find("pick");
  if (pick == json.end())
  {
    return {};
  }
  if (!pick->is_array() || pick->size() != 2 || !(*pick)[0].is_number_integer() ||
    !(*pick)[1].is_number_integer() || (*pick)[0] < 0 || (*pick)[0] >= camera.Width ||
    (*pick)[1] < 0 || (*pick)[1] >= camera.Height)
  {
    throw Error(Where, "pick is no pixel of the picture", "", "two whole numbers");
  }
  return Eigen::Vector2i((*pick)[0].get<int>(), (*pick)[1].get<int>());
}
}

FrameRequest ParseFrameRequest(const std::string& text)
{
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object())
  {
    throw Error(Where, "is no JSON object");
  }
  FrameRequest request;
  request.Cam.K = MatrixOf<3, 3>(json, "K");
  request.Cam.R = MatrixOf<3, 3>(json, "R");
  request.Cam.T = MatrixOf<3, 1>(json, "T");
  request.Cam.Width = SideOf(json, "width");
  request.Cam.Height = SideOf(json, "height");
  ValidateCamera(request.Cam, Where);
  const auto stage = json.find("stage");
  const std::optional<Stage> upTo = stage != json.end() && stage->is_string()
    ? StageOfName(stage->get<std::string>())
    : std::nullopt;
  if (!upTo)
  {
    throw Error(Where, "stage is unknown", "", "hull, outline or full");
  }
  request.UpTo = *upTo;
  request.Show = ShowOf(json);
  request.Pick = PickOf(json, request.Cam);
  return request;
}
}
