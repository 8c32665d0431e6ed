// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: bad input gets one clear error that names the array or the fibre, and nothing crashes.
#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkStringOutputWindow.h>
#include <vtkTrivialProducer.h>
#include <vtkWriter.h>

#include <vtkCapsuleOptimizer.h>
#include <vtkFibreRadialGrowth.h>
#include <vtkStrandWriter.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// Two parallel fibres of three control points in a cube of 10 µm.
vtkSmartPointer<vtkPolyData> twoFibres()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> radius;
  radius->SetName("Radius");
  for (int fibre = 0; fibre < 2; ++fibre)
  {
    lines->InsertNextCell(3);
    for (int i = 0; i < 3; ++i)
    {
      lines->InsertCellPoint(points->InsertNextPoint(2.0 * fibre, 0.0, 5.0 * i - 5.0));
      radius->InsertNextValue(0.5);
    }
  }
  vtkNew<vtkDoubleArray> domain;
  domain->SetName("Domain");
  for (int axis = 0; axis < 3; ++axis)
  {
    domain->InsertNextValue(-5.0);
    domain->InsertNextValue(5.0);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetPointData()->AddArray(radius);
  data->GetFieldData()->AddArray(domain);
  return data;
}

void addIds(vtkPolyData* data, const char* name, std::vector<int> values)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  for (int value : values)
  {
    array->InsertNextValue(value);
  }
  data->GetCellData()->AddArray(array);
}

struct BadInput
{
  const char* name;
  std::function<void(vtkPolyData*)> spoil;
  std::string message; ///< the required text of the error
};

void addOnes(vtkFieldData* data, const char* name, int count)
{
  vtkNew<vtkDoubleArray> ones;
  ones->SetName(name);
  ones->SetNumberOfValues(count);
  ones->Fill(1.0);
  data->AddArray(ones);
}

std::vector<BadInput> badInputs()
{
  return {
    { "Empty", [](vtkPolyData* data) { data->Initialize(); }, "no fibres" },
    { "NoRadius", [](vtkPolyData* data) { data->GetPointData()->RemoveArray("Radius"); }, "no point data array Radius" },
    { "RadiusOfTooFew", [](vtkPolyData* data) { data->GetPointData()->GetArray("Radius")->SetNumberOfTuples(2); },
      "array Radius must have one component and 6 values" },
    { "RadiusOfThreeComponents",
      [](vtkPolyData* data)
      {
        vtkNew<vtkDoubleArray> radius;
        radius->SetName("Radius");
        radius->SetNumberOfComponents(3);
        radius->SetNumberOfTuples(6);
        radius->Fill(1.0);
        data->GetPointData()->AddArray(radius);
      },
      "array Radius must have one component" },
    { "MyelinFractionOfText",
      [](vtkPolyData* data)
      {
        vtkNew<vtkStringArray> text;
        text->SetName("MyelinFraction");
        text->SetNumberOfValues(6);
        data->GetPointData()->AddArray(text);
      },
      "array MyelinFraction must hold numbers" },
    { "MyelinFractionOfCells", [](vtkPolyData* data) { addOnes(data->GetCellData(), "MyelinFraction", 2); },
      "array MyelinFraction must be point data" },
    { "MyelinFractionOfTooFew", [](vtkPolyData* data) { addOnes(data->GetPointData(), "MyelinFraction", 5); },
      "array MyelinFraction must have one component and 6 values" },
    { "GRatioOfPoints", [](vtkPolyData* data) { addOnes(data->GetPointData(), "TargetGRatio", 6); },
      "array TargetGRatio must be cell data" },
    { "FibreIdOfPoints", [](vtkPolyData* data) { addOnes(data->GetPointData(), "FibreId", 6); },
      "array FibreId must be cell data, a value per fibre" },
    { "AxisRatioOfTooMany", [](vtkPolyData* data) { addOnes(data->GetCellData(), "TargetAxisRatio", 3); },
      "array TargetAxisRatio must have one component and 2 values" },
    { "NegativeRadius", [](vtkPolyData* data) { data->GetPointData()->GetArray("Radius")->SetComponent(4, 0, -0.5); },
      "fibre 2 (cell 1), control point 1: Radius is -0.5" },
    { "ZeroRadius", [](vtkPolyData* data) { data->GetPointData()->GetArray("Radius")->SetComponent(4, 0, 0.0); },
      "fibre 2 (cell 1), control point 1: Radius is 0" },
    { "RadiusNotANumber", [](vtkPolyData* data) { data->GetPointData()->GetArray("Radius")->SetComponent(4, 0, notANumber); },
      "fibre 2 (cell 1), control point 1: Radius is" },
    { "CoordinateNotANumber", [](vtkPolyData* data) { data->GetPoints()->SetPoint(3, 0.0, notANumber, 0.0); },
      "fibre 2 (cell 1), control point 0: a coordinate is" },
    { "CoordinateInfinite",
      [](vtkPolyData* data) { data->GetPoints()->SetPoint(3, std::numeric_limits<double>::infinity(), 0.0, 0.0); },
      "fibre 2 (cell 1), control point 0: a coordinate is" },
    { "ZeroLengthSegment",
      [](vtkPolyData* data)
      {
        double point[3];
        data->GetPoint(3, point);
        data->GetPoints()->SetPoint(4, point);
      },
      "fibre 2 (cell 1), control point 1 coincides with the one before it" },
    { "OnePointFibre",
      [](vtkPolyData* data)
      {
        vtkNew<vtkCellArray> lines;
        lines->InsertNextCell({ 0, 1, 2 });
        lines->InsertNextCell({ 3 });
        data->SetLines(lines);
      },
      "fibre 2 (cell 1) has 1 control point(s): a fibre needs at least two" },
    { "FibreWithoutPoints",
      [](vtkPolyData* data)
      {
        vtkNew<vtkCellArray> lines;
        lines->InsertNextCell({ 0, 1, 2 });
        lines->InsertNextCell(0);
        data->SetLines(lines);
      },
      "fibre 2 (cell 1) has" },
    { "Triangles",
      [](vtkPolyData* data)
      {
        data->SetPolys(data->GetLines());
        data->SetLines(nullptr);
      },
      "not polylines" },
    { "PolylinesAndVertices",
      [](vtkPolyData* data)
      {
        vtkNew<vtkCellArray> vertices;
        vertices->InsertNextCell({ 0 });
        data->SetVerts(vertices);
      },
      "not polylines" },
    { "SharedFibreId",
      [](vtkPolyData* data) {
        addIds(data, "FibreId", { 7, 7 });
      },
      "fibre 7 (cell 1) shares its FibreId" },
    { "FibreIdOfZero",
      [](vtkPolyData* data) {
        addIds(data, "FibreId", { 0, 1 });
      },
      "ids count from 1" },
    { "BundleIdOfZero",
      [](vtkPolyData* data) {
        addIds(data, "BundleId", { 1, 0 });
      },
      "ids count from 1" },
    { "FibreIdOfTooFew", [](vtkPolyData* data) { addIds(data, "FibreId", { 1 }); }, "array FibreId must have" },
    { "DomainOfFiveNumbers", [](vtkPolyData* data) { data->GetFieldData()->GetArray("Domain")->SetNumberOfTuples(5); },
      "field data Domain" },
    { "DomainInsideOut", [](vtkPolyData* data) { data->GetFieldData()->GetArray("Domain")->SetComponent(0, 0, 6.0); }, "Domain" },
    { "DomainNotANumber", [](vtkPolyData* data) { data->GetFieldData()->GetArray("Domain")->SetComponent(0, 0, notANumber); },
      "Domain" },
  };
}

/// Runs an algorithm on fibres; returns the errors that it reports.
std::vector<std::string> errorsOf(vtkAlgorithm* algorithm, vtkPolyData* input)
{
  std::vector<std::string> errors;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&errors);
  observer->SetCallback([](vtkObject*, unsigned long, void* client, void* text)
    { static_cast<std::vector<std::string>*>(client)->push_back(static_cast<const char*>(text)); });
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ErrorEvent, observer);
  // The executive adds its own remark to each failure.
  vtkNew<vtkStringOutputWindow> quiet;
  vtkOutputWindow::SetInstance(quiet);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(input);
  algorithm->SetInputConnection(producer->GetOutputPort());
  if (auto* writer = vtkWriter::SafeDownCast(algorithm))
  {
    writer->Write();
  }
  else
  {
    algorithm->Update();
  }
  vtkOutputWindow::SetInstance(nullptr);
  algorithm->RemoveObserver(tag);
  return errors;
}

bool exists(const std::string& path)
{
  return std::ifstream(path).good();
}

template <typename Filter>
class FibreInput : public testing::Test
{
protected:
  void SetUp() override
  {
    if constexpr (std::is_base_of_v<vtkWriter, Filter>)
    {
      filter->SetFileName(path.c_str());
    }
  }
  void TearDown() override { std::remove(path.c_str()); }

  const std::string path = testing::TempDir() + "cactus_fibre_input_" + std::to_string(::getpid()) + ".strands";
  vtkNew<Filter> filter;
};

using Filters = testing::Types<vtkStrandWriter, vtkCapsuleOptimizer, vtkFibreRadialGrowth>;
TYPED_TEST_SUITE(FibreInput, Filters);

TYPED_TEST(FibreInput, GoodOneGivesNoError)
{
  EXPECT_TRUE(errorsOf(this->filter, twoFibres()).empty());
}

TYPED_TEST(FibreInput, BadOneGivesOneErrorThatNamesIt)
{
  for (const BadInput& bad : badInputs())
  {
    SCOPED_TRACE(bad.name);
    auto data = twoFibres();
    bad.spoil(data);
    vtkNew<TypeParam> filter;
    if constexpr (std::is_base_of_v<vtkWriter, TypeParam>)
    {
      filter->SetFileName(this->path.c_str());
    }
    const auto errors = errorsOf(filter, data);
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_NE(errors[0].find(bad.message), std::string::npos) << errors[0];
    EXPECT_FALSE(exists(this->path));
  }
}

TYPED_TEST(FibreInput, RecoversFromABadOne)
{
  auto bad = twoFibres();
  bad->GetPointData()->RemoveArray("Radius");
  EXPECT_EQ(errorsOf(this->filter, bad).size(), 1U);
  EXPECT_TRUE(errorsOf(this->filter, twoFibres()).empty());
}

TEST(StrandWriter, SaysThatItHasNoFileName)
{
  vtkNew<vtkStrandWriter> writer;
  const auto errors = errorsOf(writer, twoFibres());
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NE(errors[0].find("FileName is empty"), std::string::npos) << errors[0];
}

} // namespace
