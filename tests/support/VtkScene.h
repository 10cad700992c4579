// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes and meshes of Scene.h as the filters take them, and what to say about any filter.
#ifndef support_VtkScene_h
#define support_VtkScene_h

#include "ViewAccess.h"
#include "support/Scene.h"
#include "vtkPinholeCamera.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace support
{
inline vtkSmartPointer<vtkMultiBlockDataSet> ToBlocks(const std::vector<Photo>& photos)
{
  auto views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const Photo& photo : photos)
  {
    const auto image = novelview::NewImage(photo.Cam.Width, photo.Cam.Height);
    novelview::CopyToArray(photo.Color, novelview::arrays::Color, image);
    novelview::CopyToArray(photo.Mask, novelview::arrays::Mask, image);
    novelview::CopyToArray(photo.ContourDistance, novelview::arrays::ContourDistance, image);
    novelview::AppendView(views, photo.Name, image, photo.Cam);
  }
  return views;
}

inline vtkSmartPointer<vtkPolyData> ToPolyData(const novelview::TriangleMesh& mesh)
{
  auto poly = vtkSmartPointer<vtkPolyData>::New();
  novelview::FromTriangleMesh(mesh, poly);
  return poly;
}

/** Texts of an event of a filter (or its executive), in order. */
class EventTexts
{
public:
  EventTexts(vtkObject* object, unsigned long event)
    : Object(object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* data)
      {
        static_cast<EventTexts*>(self)->Texts.emplace_back(
          data ? static_cast<const char*>(data) : "");
      });
    this->Tag = object->AddObserver(event, this->Command);
  }
  ~EventTexts() { this->Object->RemoveObserver(this->Tag); }
  EventTexts(const EventTexts&) = delete;
  void operator=(const EventTexts&) = delete;
  std::vector<std::string> Texts;

private:
  vtkSmartPointer<vtkObject> Object;
  unsigned long Tag = 0;
  vtkNew<vtkCallbackCommand> Command;
};

/** Expects an update to fail with one ErrorEvent that holds `text`, and to leave no output. */
inline void ExpectUpdateError(vtkAlgorithm* filter, const std::string& text)
{
  EventTexts errors(filter, vtkCommand::ErrorEvent);
  // The executive adds another line about the failed request; observed here, it is not printed.
  EventTexts executiveErrors(filter->GetExecutive(), vtkCommand::ErrorEvent);
  filter->Update();
  ASSERT_EQ(errors.Texts.size(), 1u) << "expected one error with: " << text;
  EXPECT_THAT(errors.Texts.front(), testing::HasSubstr(text));
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = filter->GetOutputDataObject(port);
    EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::POINT), 0);
  }
}

inline std::string Printed(vtkObject* object)
{
  std::ostringstream text;
  object->Print(text);
  return text.str();
}

/** Expects PrintSelf to name every member given. */
inline void ExpectPrints(vtkObject* object, const std::vector<std::string>& members)
{
  const std::string text = Printed(object);
  for (const std::string& member : members)
  {
    EXPECT_THAT(text, testing::HasSubstr(member + ":"));
  }
}

/** Points and triangles, to be compared with ==. */
inline std::pair<std::vector<Vector3d>, std::vector<Eigen::Vector3i>> Geometry(vtkPolyData* poly)
{
  const novelview::TriangleMesh mesh = novelview::ToTriangleMesh(poly, "test");
  return { mesh.Points, mesh.Triangles };
}
}

#endif
