// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCapsuleOptimizer.h"

#include "CapsuleOptimizer.h"
#include "FibreData.h"
#include "FibreShape.h"
#include "FilterSupport.h"
#include "TrimToDomain.h"
#include "WholeData.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <algorithm>
#include <set>
#include <sstream>

vtkStandardNewMacro(vtkCapsuleOptimizer);

namespace
{

/// All inputs as one, with ids of their own for each.
cactus::Fibres joined(vtkInformationVector* inputs)
{
  cactus::Fibres all;
  for (int connection = 0; connection < inputs->GetNumberOfInformationObjects(); ++connection)
  {
    const cactus::Fibres fibres = cactus::fibresFrom(vtkPolyData::GetData(inputs, connection));
    if (connection == 0)
    {
      all = fibres;
      continue;
    }
    if ((fibres.domain.lower - all.domain.lower).cwiseAbs().maxCoeff() > 1e-9 ||
        (fibres.domain.upper - all.domain.upper).cwiseAbs().maxCoeff() > 1e-9)
    {
      throw cactus::InvalidInput(
        "input " + std::to_string(connection + 1) + " has another Domain than the first: give all bundles the same Side");
    }
    // Ids stay where they are free; a bundle or fibre that shares one with an earlier input moves above the largest.
    const std::set<int> bundles(all.bundleIds.begin(), all.bundleIds.end());
    const std::set<int> ids(all.fibreIds.begin(), all.fibreIds.end());
    const auto taken = [](const std::set<int>& used, const std::vector<int>& wanted)
    { return std::any_of(wanted.begin(), wanted.end(), [&](int id) { return used.count(id) > 0; }); };
    const int bundleShift = taken(bundles, fibres.bundleIds) ? *bundles.rbegin() : 0;
    const int fibreShift = taken(ids, fibres.fibreIds) ? *ids.rbegin() : 0;
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      all.addFibre(fibres.fibreIds[f] + fibreShift, fibres.bundleIds[f] + bundleShift, fibres.targetRadii[f]);
      for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
      {
        all.addPoint(fibres.points[i], fibres.radii[i]);
      }
    }
  }
  cactus::validate(all);
  return all;
}

template <typename Value>
void addColumn(
  vtkTable* table, const char* name, const std::vector<cactus::ConvergenceRow>& rows, Value cactus::ConvergenceRow::*member)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  column->SetNumberOfValues(static_cast<vtkIdType>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    column->SetValue(static_cast<vtkIdType>(i), static_cast<double>(rows[i].*member));
  }
  table->AddColumn(column);
}

void fillTable(const std::vector<cactus::ConvergenceRow>& rows, vtkTable* table)
{
  using Row = cactus::ConvergenceRow;
  addColumn(table, "Iteration", rows, &Row::iteration);
  addColumn(table, "OverlapCost", rows, &Row::overlapCost);
  addColumn(table, "MaximumPenetration", rows, &Row::maximumPenetration);
  addColumn(table, "OverlappingPairs", rows, &Row::overlappingPairs);
  addColumn(table, "CurvatureCost", rows, &Row::curvatureCost);
  addColumn(table, "LengthCost", rows, &Row::lengthCost);
  addColumn(table, "RadiusCost", rows, &Row::radiusCost);
  addColumn(table, "CompactnessCost", rows, &Row::compactnessCost);
  addColumn(table, "Seconds", rows, &Row::seconds);
}

void setNumber(vtkDataObject* data, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}

const char* reasonText(cactus::StopReason reason)
{
  switch (reason)
  {
  case cactus::StopReason::MaximumIterations:
    return "MaximumIterations were used up";
  case cactus::StopReason::Stagnated:
    return "nothing more was gained";
  case cactus::StopReason::TimeBudget:
    return "TimeBudget ran out";
  case cactus::StopReason::Stopped:
    return "the run was stopped";
  default:
    return "converged";
  }
}

} // namespace

vtkCapsuleOptimizer::vtkCapsuleOptimizer()
{
  this->SetNumberOfOutputPorts(2);
}

int vtkCapsuleOptimizer::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkCapsuleOptimizer::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkTable");
  return 1;
}

int vtkCapsuleOptimizer::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  cactus::requestWholeInputs(inputs, 1);
  return 1;
}

int vtkCapsuleOptimizer::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!cactus::ownsWholeOutput(outputs))
  {
    return 1;
  }
  return cactus::guarded(this,
    [&]
    {
      if (this->Method != MOMENTUM && this->Method != ADAGRAD)
      {
        throw cactus::InvalidInput("Method must be Momentum (0) or Adagrad (1)");
      }
      if (this->NumberOfThreads < 0)
      {
        throw cactus::InvalidInput("NumberOfThreads must be 0 (all) or more");
      }
      cactus::CapsuleOptimizerOptions options;
      options.maximumIterations = this->MaximumIterations;
      options.overlapTolerance = this->OverlapTolerance;
      options.method = static_cast<cactus::DescentMethod>(this->Method);
      options.overlapWeight = this->OverlapWeight;
      options.weights.curvature = this->CurvatureWeight;
      options.weights.length = this->LengthWeight;
      options.weights.radius = this->RadiusWeight;
      options.weights.compactness = this->CompactnessWeight;
      options.stepSize = this->StepSize;
      options.relaxation = this->Relaxation;
      options.packingLimit = this->PackingLimit;
      options.radiusTolerance = this->RadiusTolerance;
      options.timeBudget = this->TimeBudget;
      cactus::validate(options);

      cactus::Fibres fibres = joined(inputs[0]);
      const cactus::FibreShape before = cactus::measureShape(fibres);
      const cactus::OptimisationResult result =
        cactus::optimise(fibres, options, cactus::contextFor(this, this->NumberOfThreads));
      const cactus::FibreShape after = cactus::measureShape(fibres);

      auto* output = vtkPolyData::GetData(outputs, 0);
      std::vector<std::size_t> kept(fibres.points.size());
      for (std::size_t i = 0; i < kept.size(); ++i)
      {
        kept[i] = i;
      }
      if (this->TrimToDomain)
      {
        fibres = cactus::trimToDomain(fibres, &kept);
      }
      if (fibres.size() == 0)
      {
        throw cactus::InvalidInput("no fibre comes near the Domain: check its position, or switch TrimToDomain off");
      }
      cactus::toPolyData(fibres, output);
      vtkNew<vtkDoubleArray> overlap;
      overlap->SetName("Overlap");
      overlap->SetNumberOfValues(static_cast<vtkIdType>(kept.size()));
      for (std::size_t i = 0; i < kept.size(); ++i)
      {
        overlap->SetValue(static_cast<vtkIdType>(i), result.overlap[kept[i]]);
      }
      output->GetPointData()->AddArray(overlap);

      const bool converged = result.maximumPenetration <= options.overlapTolerance;
      vtkNew<vtkIntArray> flag;
      flag->SetName("Converged");
      flag->InsertNextValue(converged ? 1 : 0);
      output->GetFieldData()->AddArray(flag);
      setNumber(output, "MaximumPenetration", result.maximumPenetration);
      setNumber(output, "InitialMeanDispersion", before.meanDispersion);
      setNumber(output, "MeanDispersion", after.meanDispersion);
      setNumber(output, "InitialTangentDispersion", before.tangentDispersion);
      setNumber(output, "TangentDispersion", after.tangentDispersion);
      setNumber(output, "InitialCrossingAngle", before.crossingAngle);
      setNumber(output, "CrossingAngle", after.crossingAngle);
      setNumber(output, "SmallestBendRadius", after.smallestBendRadius);
      setNumber(output, "LengthIncrease", after.totalLength / before.totalLength - 1.0);

      std::ostringstream parameters;
      parameters.precision(15);
      parameters << "MaximumIterations=" << this->MaximumIterations << " OverlapTolerance=" << this->OverlapTolerance
                 << " Method=" << (this->Method == MOMENTUM ? "Momentum" : "Adagrad") << " OverlapWeight=" << this->OverlapWeight
                 << " CurvatureWeight=" << this->CurvatureWeight << " LengthWeight=" << this->LengthWeight
                 << " RadiusWeight=" << this->RadiusWeight << " CompactnessWeight=" << this->CompactnessWeight
                 << " StepSize=" << this->StepSize << " Relaxation=" << this->Relaxation << " PackingLimit=" << this->PackingLimit
                 << " RadiusTolerance=" << this->RadiusTolerance << " TrimToDomain=" << this->TrimToDomain
                 << " TimeBudget=" << this->TimeBudget << " (" << result.convergence.back().iteration
                 << " iterations, largest penetration " << result.maximumPenetration << ")";
      cactus::addProvenance(vtkPolyData::GetData(inputs[0]), output, "CapsuleOptimizer", parameters.str());
      fillTable(result.convergence, vtkTable::GetData(outputs, 1));

      if (!converged)
      {
        vtkWarningMacro(<< "overlaps remain: " << reasonText(result.reason) << " after " << result.convergence.back().iteration
                        << " iterations with " << result.overlappingPairs << " capsule pairs above OverlapTolerance "
                        << options.overlapTolerance << ", the largest penetration being " << result.maximumPenetration
                        << ". The best state is kept. Allow more iterations or time, or ask for a lower density.");
      }
    });
}

void vtkCapsuleOptimizer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumIterations: " << this->MaximumIterations << '\n';
  os << indent << "OverlapTolerance: " << this->OverlapTolerance << '\n';
  os << indent << "Method: " << (this->Method == MOMENTUM ? "Momentum" : "Adagrad") << '\n';
  os << indent << "OverlapWeight: " << this->OverlapWeight << '\n';
  os << indent << "CurvatureWeight: " << this->CurvatureWeight << '\n';
  os << indent << "LengthWeight: " << this->LengthWeight << '\n';
  os << indent << "RadiusWeight: " << this->RadiusWeight << '\n';
  os << indent << "CompactnessWeight: " << this->CompactnessWeight << '\n';
  os << indent << "StepSize: " << this->StepSize << '\n';
  os << indent << "Relaxation: " << this->Relaxation << '\n';
  os << indent << "PackingLimit: " << this->PackingLimit << '\n';
  os << indent << "RadiusTolerance: " << this->RadiusTolerance << '\n';
  os << indent << "TrimToDomain: " << this->TrimToDomain << '\n';
  os << indent << "TimeBudget: " << this->TimeBudget << '\n';
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}
