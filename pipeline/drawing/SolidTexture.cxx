// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/SolidTexture.h"

#include "base/NumberText.h"
#include "core/Error.h"

#include <vtkBoundingBox.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

namespace novelview
{
namespace
{
constexpr const char* PlaceArray = "SolidTexturePlace";
constexpr const char* NormalArray = "SolidTextureNormal";

// Places are in units of the bounding box's diagonal, the centre of the box is the origin.
constexpr const char* NoiseSource = R"(
uint Hash(uint a)
{
  a ^= a >> 16;
  a *= 0x7feb352du;
  a ^= a >> 15;
  a *= 0x846ca68bu;
  return a ^ (a >> 16);
}
float Lattice(ivec3 c)
{
  uint mixed = Hash(uint(c.x) + Hash(uint(c.y) + Hash(uint(c.z) + Hash(uint(seed)))));
  return float(mixed) / 4294967295.0;
}
// Value noise, -1 to 1, smooth, one lattice cell per unit.
float Noise(vec3 p)
{
  ivec3 c = ivec3(floor(p));
  vec3 t = p - floor(p);
  t = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
  float low = mix(mix(Lattice(c), Lattice(c + ivec3(1, 0, 0)), t.x),
    mix(Lattice(c + ivec3(0, 1, 0)), Lattice(c + ivec3(1, 1, 0)), t.x), t.y);
  float high = mix(mix(Lattice(c + ivec3(0, 0, 1)), Lattice(c + ivec3(1, 0, 1)), t.x),
    mix(Lattice(c + ivec3(0, 1, 1)), Lattice(c + ivec3(1, 1, 1)), t.x), t.y);
  return 2.0 * mix(low, high, t.z) - 1.0;
}
float Turbulence(vec3 p)
{
  return 0.5 * Noise(p) + 0.25 * Noise(2.03 * p + 17.1) + 0.125 * Noise(4.01 * p + 5.7) +
    0.0625 * Noise(8.07 * p + 29.3);
}
)";

/** A built-in texture. */
struct Texture
{
  std::string Name;
  const char* Source; ///< of the GLSL function SolidColour()
};

/** All built-in textures, in the order of the help. */
const std::vector<Texture>& Textures()
{
  static const std::vector<Texture> textures = {
    // Year rings about a slightly tilted axis, bent by turbulence; pores drawn out along the axis;
    // and a speckle of a few pixels, as real end grain has.
    { "wood", R"(
vec3 SolidColour(vec3 p)
{
  vec3 q = vec3(p.x + 0.16 * p.y + 0.21, p.y, p.z - 0.23 * p.y + 0.13);
  vec3 bent = q + 0.055 * vec3(Turbulence(5.0 * q), 0.0, Turbulence(5.0 * q + 31.0));
  float radius = 26.0 * length(bent.xz) + 0.5 * Noise(9.0 * q);
  float year = radius - floor(radius);
  float late = smoothstep(0.25, 0.85, year) * (1.0 - smoothstep(0.88, 1.0, year));
  float tone = 0.5 + 0.5 * Lattice(ivec3(int(floor(radius)), 7, 11));
  float pores = Noise(vec3(190.0, 22.0, 190.0) * bent);
  float speckle = Noise(120.0 * p) + 0.7 * Noise(240.0 * p + 3.3);
  float dark = clamp(0.26 + 0.60 * late * tone + 0.20 * pores + 0.17 * speckle +
    0.22 * Turbulence(6.0 * p), 0.0, 1.0);
  return mix(vec3(0.98, 0.77, 0.51), vec3(0.31, 0.15, 0.06), dark);
}
)" },
    { "marble", R"(
vec3 SolidColour(vec3 p)
{
  float bend = Turbulence(7.0 * p);
  float vein = 1.0 - abs(sin(24.0 * (p.x + 0.6 * p.y - 0.35 * p.z) + 9.0 * bend));
  float along = 61.0 * (0.4 * p.x - 0.7 * p.y + 0.6 * p.z);
  float fine = 1.0 - abs(sin(along + 13.0 * Turbulence(11.0 * p + 3.0)));
  float dark = clamp(0.75 * pow(vein, 4.0) + 0.35 * pow(fine, 6.0) + 0.10 * Noise(70.0 * p) +
    0.07 * Noise(150.0 * p) + 0.2 * bend, 0.0, 1.0);
  return mix(vec3(0.90, 0.89, 0.86), vec3(0.28, 0.31, 0.36), dark);
}
)" },
    // No two fields are alike, since a regular pattern matches itself everywhere.
    { "checker", R"(
vec3 SolidColour(vec3 p)
{
  vec3 cell = floor(18.0 * p + 0.37);
  ivec3 c = ivec3(cell);
  float tone = Lattice(c);
  bool odd = ((c.x + c.y + c.z) & 1) != 0;
  vec3 light = mix(vec3(0.90, 0.86, 0.74), vec3(0.80, 0.83, 0.90), tone);
  vec3 dark = mix(vec3(0.16, 0.22, 0.42), vec3(0.45, 0.18, 0.16), tone);
  return (odd ? light : dark) * (1.0 + 0.06 * Noise(130.0 * p));
}
)" },
    { "plaster", R"(
vec3 SolidColour(vec3 p)
{
  return vec3(0.88, 0.87, 0.85) * (1.0 + 0.025 * Turbulence(9.0 * p) + 0.012 * Noise(110.0 * p));
}
)" },
    { "grey", R"(
vec3 SolidColour(vec3 p)
{
  return vec3(0.52);
}
)" },
  };
  return textures;
}

/** The GLSL source of a texture. Throws Error with the known names if there is none of this name. */
const char* SourceOf(const std::string& name)
{
  for (const Texture& texture : Textures())
  {
    if (texture.Name == name)
    {
      return texture.Source;
    }
  }
  throw Error("texture", "there is no such texture", "\"" + name + "\"", Joined(TextureNames()));
}

// A key light from the upper right front, a weaker one from the left back, and sky over ground. They
// are fixed to the object's frame, so that a surface keeps its brightness from one photograph to the
// next, or to that of the camera.
constexpr const char* WorldLight = R"(
vec3 KeyLight() { return normalize(vec3(0.55, 0.65, 0.75)); }
float Shade(vec3 n)
{
  float key = max(dot(n, normalize(vec3(0.55, 0.65, 0.75))), 0.0);
  float fill = max(dot(n, normalize(vec3(-0.75, 0.15, -0.45))), 0.0);
  return 0.56 + 0.08 * n.y + 0.36 * key + 0.18 * fill;
}
)";

constexpr const char* RigLight = R"(
vec3 WithRig(vec3 d)
{
  vec2 z = normalize(eye.xz + vec2(0.0, 1e-9));
  return vec3(d.x * z.y + d.z * z.x, d.y, d.z * z.y - d.x * z.x);
}
vec3 KeyLight() { return WithRig(normalize(vec3(0.55, 0.65, 0.75))); }
float Shade(vec3 n)
{
  float key = max(dot(n, KeyLight()), 0.0);
  float fill = max(dot(n, WithRig(normalize(vec3(-0.75, 0.15, 0.45)))), 0.0);
  return 0.36 + 0.08 * n.y + 0.62 * key + 0.16 * fill;
}
)";

// `at` in the coordinates of the mesh, from the centre of its box.
constexpr const char* GlossSource = R"(
float Highlight(vec3 n, vec3 at)
{
  vec3 middle = normalize(KeyLight() + normalize(eye - at));
  return gloss * pow(max(dot(n, middle), 0.0), 50.0);
}
)";

constexpr const char* ShadowSource = R"(
float ShadowAt(vec3 p)
{
  float edge = p.y + 0.10 + 0.35 * p.x;
  return 1.0 - darkness * (1.0 - smoothstep(-0.01, 0.01, edge));
}
)";

/** The rendered geometry: centred, with normals and the place in the texture. */
vtkSmartPointer<vtkPolyData> RenderedGeometry(vtkPolyData* mesh, double centre[3])
{
  vtkBoundingBox box(mesh->GetBounds());
  box.GetCenter(centre);
  const double diagonal = box.GetDiagonalLength();
  if (!(diagonal > 0))
  {
    throw Error("mesh", "all points are at the same place");
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SetFeatureAngle(50);
  normals->ConsistencyOff();
  normals->Update();
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  geometry->DeepCopy(normals->GetOutput());
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(geometry->GetNumberOfPoints());
  vtkNew<vtkFloatArray> places;
  places->SetName(PlaceArray);
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(geometry->GetNumberOfPoints());
  for (vtkIdType ptId = 0; ptId < geometry->GetNumberOfPoints(); ++ptId)
  {
    double point[3];
    geometry->GetPoint(ptId, point);
    for (int c = 0; c < 3; ++c)
    {
      point[c] -= centre[c];
      places->SetComponent(ptId, c, point[c] / diagonal);
    }
    points->SetPoint(ptId, point);
  }
  geometry->SetPoints(points);
  geometry->GetPointData()->AddArray(places);
  geometry->GetPointData()->GetNormals()->SetName(NormalArray);
  return geometry;
}

/** The colour of a pixel, in GLSL. */
std::string ColourSource(const SurfaceLook& look)
{
  std::string colour = "SolidColour(place) * ";
  colour += look.Lit ? "Shade(normalize(facing))" : "1.0";
  colour += " * ShadowAt(place)";
  if (look.Gloss > 0)
  {
    colour += " + Highlight(normalize(facing), place * diagonal)";
  }
  return look.Exposure == 1 ? colour : "exposure * (" + colour + ")";
}

void ReplaceShaders(vtkShaderProperty* shaders, const SurfaceLook& look)
{
  shaders->AddVertexShaderReplacement("//VTK::PositionVC::Dec", true,
    "//VTK::PositionVC::Dec\nin vec3 placeMC;\nin vec3 facingMC;\nout vec3 place;\nout vec3 "
    "facing;\n",
    false);
  shaders->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
    "//VTK::PositionVC::Impl\n  place = placeMC;\n  facing = facingMC;\n", false);
  const std::string declarations = std::string("//VTK::PositionVC::Dec\nin vec3 place;\n") +
    "in vec3 facing;\n" + NoiseSource + SourceOf(look.Texture) +
    (look.LitFromRig ? RigLight : WorldLight) + GlossSource + ShadowSource;
  shaders->AddFragmentShaderReplacement("//VTK::PositionVC::Dec", true, declarations, false);
  shaders->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
    "  gl_FragData[0] = vec4(" + ColourSource(look) + ", 1.0);\n", false);
}
}

//------------------------------------------------------------------------------
const std::vector<std::string>& TextureNames()
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> each;
    for (const Texture& texture : Textures())
    {
      each.push_back(texture.Name);
    }
    return each;
  }();
  return names;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkActor> NewTexturedActor(
  vtkPolyData* mesh, const SurfaceLook& look, double centre[3])
{
  vtkNew<vtkOpenGLPolyDataMapper> mapper;
  mapper->SetInputData(RenderedGeometry(mesh, centre));
  mapper->ScalarVisibilityOff();
  mapper->MapDataArrayToVertexAttribute(
    "placeMC", PlaceArray, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  mapper->MapDataArrayToVertexAttribute(
    "facingMC", NormalArray, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  ReplaceShaders(actor->GetShaderProperty(), look);
  vtkUniforms* uniforms = actor->GetShaderProperty()->GetFragmentCustomUniforms();
  uniforms->SetUniformi("seed", look.Seed);
  uniforms->SetUniformf("gloss", static_cast<float>(look.Gloss));
  uniforms->SetUniformf("exposure", static_cast<float>(look.Exposure));
  uniforms->SetUniformf(
    "diagonal", static_cast<float>(vtkBoundingBox(mesh->GetBounds()).GetDiagonalLength()));
  SetShadow(actor, 0);
  const double front[3] = { 0, 0, 1 };
  SetEye(actor, front);
  return actor;
}

//------------------------------------------------------------------------------
void SetEye(vtkActor* texturedActor, const double eyeFromCentre[3])
{
  const float eye[3] = { static_cast<float>(eyeFromCentre[0]), static_cast<float>(eyeFromCentre[1]),
    static_cast<float>(eyeFromCentre[2]) };
  texturedActor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform3f("eye", eye);
}

//------------------------------------------------------------------------------
void SetShadow(vtkActor* texturedActor, double darkness)
{
  texturedActor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(
    "darkness", static_cast<float>(darkness));
}
}
