// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/GltfFile.h"

#include "ViewAccess.h"
#include "base/ByteStream.h"
#include "images/ImageFile.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <bit>
#include <cstdint>
#include <limits>

static_assert(std::endian::native == std::endian::little, "GLB is written as it is in memory");

namespace novelview
{
using Json = nlohmann::ordered_json;

namespace
{
// Numbers of the specification.
constexpr int Float = 5126;
constexpr int UnsignedInt = 5125;
constexpr int VertexBuffer = 34962;
constexpr int IndexBuffer = 34963;
constexpr int LinearFilter = 9729;
constexpr int LinearMipmapLinear = 9987;
constexpr int ClampToEdge = 33071;
constexpr std::uint32_t JsonChunk = 0x4E4F534A;
constexpr std::uint32_t BinaryChunk = 0x004E4942;

/** The binary chunk and the JSON about it, which grow together. */
class GltfBuffer
{
public:
  /** Appends bytes as a buffer view; every view begins at a multiple of four. */
  int AddView(const void* bytes, std::size_t size, int target = 0)
  {
    Json view = { { "buffer", 0 }, { "byteOffset", this->Bytes.size() }, { "byteLength", size } };
    if (target != 0)
    {
      view["target"] = target;
    }
    this->Views.push_back(view);
    this->Bytes.append(static_cast<const char*>(bytes), size);
    this->Bytes.resize((this->Bytes.size() + 3) / 4 * 4, '\0');
    return static_cast<int>(this->Views.size()) - 1;
  }

  /** Appends an attribute of the points, with its extent. */
  int AddVectors(const std::vector<float>& values, int components)
  {
    const int view = this->AddView(values.data(), values.size() * sizeof(float), VertexBuffer);
    std::vector<float> least(components, std::numeric_limits<float>::max());
    std::vector<float> most(components, std::numeric_limits<float>::lowest());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      least[i % components] = std::min(least[i % components], values[i]);
      most[i % components] = std::max(most[i % components], values[i]);
    }
    this->Accessors.push_back(
      { { "bufferView", view }, { "componentType", Float }, { "count", values.size() / components },
        { "type", "VEC" + std::to_string(components) }, { "min", least }, { "max", most } });
    return static_cast<int>(this->Accessors.size()) - 1;
  }

  int AddIndices(const std::vector<std::uint32_t>& indices)
  {
    const int view =
      this->AddView(indices.data(), indices.size() * sizeof(std::uint32_t), IndexBuffer);
    this->Accessors.push_back({ { "bufferView", view }, { "componentType", UnsignedInt },
      { "count", indices.size() }, { "type", "SCALAR" } });
    return static_cast<int>(this->Accessors.size()) - 1;
  }

  std::string Bytes;
  Json Views = Json::array();
  Json Accessors = Json::array();
};

/** Adds the mesh's attributes and returns their accessors. */
Json PrimitiveOf(const TexturedModel& model, const TriangleMesh& mesh,
  const Eigen::Vector3d& middle, GltfBuffer& buffer)
{
  vtkPointData* pointData = model.Atlas->GetPointData();
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> coordinates;
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    const auto tuple = static_cast<vtkIdType>(ptId);
    const Eigen::Vector3f position = (mesh.Points[ptId] - middle).cast<float>();
    positions.insert(positions.end(), position.data(), position.data() + 3);
    // The specification requires normals of length 1; a missing one is replaced by any.
    Eigen::Vector3d normal(pointData->GetNormals()->GetTuple3(tuple));
    normal = normal.isZero(0) ? model.Up : normal;
    const Eigen::Vector3f unit = normal.cast<float>();
    normals.insert(normals.end(), unit.data(), unit.data() + 3);
    // VTK counts texture coordinates from the bottom.
    const double* at = pointData->GetTCoords()->GetTuple2(tuple);
    coordinates.push_back(static_cast<float>(at[0]));
    coordinates.push_back(static_cast<float>(1 - at[1]));
  }
  std::vector<std::uint32_t> indices;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    indices.insert(indices.end(), t.data(), t.data() + 3);
  }
  Json attributes;
  attributes["POSITION"] = buffer.AddVectors(positions, 3);
  attributes["NORMAL"] = buffer.AddVectors(normals, 3);
  attributes["TEXCOORD_0"] = buffer.AddVectors(coordinates, 2);
  return { { "attributes", attributes }, { "indices", buffer.AddIndices(indices) },
    { "material", 0 }, { "mode", 4 } };
}

Json NodeOf(const TexturedModel& model, const Eigen::Vector3d& middle)
{
  const Eigen::Quaterniond turn =
    Eigen::Quaterniond::FromTwoVectors(model.Up, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d moved = turn * middle;
  return { { "name", "object" }, { "mesh", 0 },
    { "rotation", { turn.x(), turn.y(), turn.z(), turn.w() } },
    { "translation", { moved.x(), moved.y(), moved.z() } } };
}
}

std::string GlbOf(const TexturedModel& model)
{
  const TriangleMesh mesh = ToTriangleMesh(model.Atlas, "glTF mesh");
  const Eigen::Vector3d middle = BoundingBox(mesh.Points).center();
  GltfBuffer buffer;
  const Json primitive = PrimitiveOf(model, mesh, middle, buffer);
  constexpr int jpegQuality = 93;
  const std::vector<std::uint8_t> jpeg = EncodeJpeg(
    TopDownArray<const std::uint8_t>(model.Texture, arrays::Color, 3, "glTF texture", true),
    jpegQuality, "glTF texture");
  const int picture = buffer.AddView(jpeg.data(), jpeg.size());

  Json gltf;
  gltf["asset"] = { { "version", "2.0" }, { "generator", "NovelView " NOVELVIEW_VERSION } };
  gltf["extensionsUsed"] = { "KHR_materials_unlit" };
  gltf["scene"] = 0;
  gltf["scenes"] = Json::array({ { { "nodes", { 0 } } } });
  gltf["nodes"] = Json::array({ NodeOf(model, middle) });
  gltf["meshes"] =
    Json::array({ { { "name", "object" }, { "primitives", Json::array({ primitive }) } } });
  gltf["materials"] = Json::array({ { { "name", "photographs" },
    { "pbrMetallicRoughness",
      { { "baseColorTexture", { { "index", 0 } } }, { "metallicFactor", 0 },
        { "roughnessFactor", 1 } } },
    { "extensions", { { "KHR_materials_unlit", Json::object() } } } } });
  gltf["textures"] = Json::array({ { { "sampler", 0 }, { "source", 0 } } });
  gltf["images"] = Json::array({ { { "bufferView", picture }, { "mimeType", "image/jpeg" } } });
  gltf["samplers"] = Json::array({ { { "magFilter", LinearFilter },
    { "minFilter", LinearMipmapLinear }, { "wrapS", ClampToEdge }, { "wrapT", ClampToEdge } } });
  gltf["accessors"] = buffer.Accessors;
  gltf["bufferViews"] = buffer.Views;
  gltf["buffers"] = Json::array({ { { "byteLength", buffer.Bytes.size() } } });

  std::string text = gltf.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t whole = 12 + 8 + text.size() + 8 + buffer.Bytes.size();
  if (whole > std::numeric_limits<std::uint32_t>::max())
  {
    throw Error("glTF", "the mesh is too large", std::to_string(whole) + " bytes", "below 4 GiB");
  }
  ByteWriter glb;
  glb.Written = "glTF";
  glb.Add<std::uint32_t>(2);
  glb.Add(static_cast<std::uint32_t>(whole));
  glb.Add(static_cast<std::uint32_t>(text.size()));
  glb.Add(JsonChunk);
  glb.Written += text;
  glb.Add(static_cast<std::uint32_t>(buffer.Bytes.size()));
  glb.Add(BinaryChunk);
  return glb.Written + buffer.Bytes;
}
}
