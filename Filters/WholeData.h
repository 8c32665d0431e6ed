// SPDX-License-Identifier: BSD-3-Clause
// For filters that need all of their input in one place, also where the pipeline runs on several ranks.
#pragma once

#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

namespace cactus
{

/// Asks for all of every input, whatever piece the caller was asked for. For RequestUpdateExtent.
inline void requestWholeInputs(vtkInformationVector** inputs, int ports)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < ports; ++port)
  {
    for (int connection = 0; connection < inputs[port]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(connection);
      info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

/// True on the rank that was asked for the first piece of the outputs: the one that gives the result, or writes it. Only the port
/// that `request` came through counts; the others may still hold what they were asked for before.
inline bool ownsWholeOutput(vtkInformation* request, vtkInformationVector* outputs)
{
  const auto piece = vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER();
  const int from = request->Has(vtkExecutive::FROM_OUTPUT_PORT()) ? request->Get(vtkExecutive::FROM_OUTPUT_PORT()) : -1;
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    if ((from < 0 || from == port) && info->Has(piece) && info->Get(piece) > 0)
    {
      return false;
    }
  }
  return true;
}

} // namespace cactus
