// SPDX-License-Identifier: BSD-3-Clause
// For filters that need all of their input in one place, also where the pipeline runs on several ranks.
#pragma once

#include <vtkAlgorithm.h>
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
      if (info->Has(Pipeline::WHOLE_EXTENT()))
      {
        // Else the executive asks for as much as the output has, which of an empty image there is not.
        int extent[6];
        info->Get(Pipeline::WHOLE_EXTENT(), extent);
        info->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
      }
    }
  }
}

/// Takes any data at an input port, so that a filter sees it as it is and says itself what it cannot work with. Were composite
/// data not among it, ParaView's executive would run the filter block by block instead, information and data by turns.
inline void acceptAnyData(vtkInformation* port)
{
  port->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
}

/// Brings all of the inputs at port 0 up to date. For RequestInformation, where what there is to tell of the output is known from
/// the data alone; what follows asks for it before the data.
///
/// This request has passed the inputs' producers when it comes here, and those further up: none of them is at work, and an update
/// goes no other way than up. Whoever updated them before may have asked this process for another piece of them.
inline void updateWholeInputs(vtkAlgorithm* self, vtkInformationVector** inputs)
{
  requestWholeInputs(inputs, 1);
  for (int connection = 0; connection < self->GetNumberOfInputConnections(0); ++connection)
  {
    int port = 0;
    if (vtkAlgorithm* producer = self->GetInputAlgorithm(0, connection, port))
    {
      producer->Update(port);
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
