// SPDX-License-Identifier: BSD-3-Clause
// Support for filters that need all of their input in one place, also if the pipeline runs on several ranks.
#pragma once

#include <vtkAlgorithm.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

namespace cactus
{

/// Requests all of every input, whatever piece the caller requested. For RequestUpdateExtent.
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
        // Otherwise the executive requests the extent of the output, which an empty image does not have.
        int extent[6];
        info->Get(Pipeline::WHOLE_EXTENT(), extent);
        info->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
      }
    }
  }
}

/// Accepts any data at an input port, so that a filter sees them as they are and reports itself what it cannot use. Without
/// composite data in the list, ParaView's executive would run the filter block by block, information and data by turns.
inline void acceptAnyData(vtkInformation* port)
{
  port->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
}

/// Updates all inputs at port 0. For RequestInformation, if the output's information depends on the data; later stages request it
/// before the data.
///
/// This request has already passed the inputs' producers and those further up: none of them is running, and an update only goes
/// upstream. An earlier update may have asked this process for another piece of them.
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

/// Tells whether this rank was asked for the first piece of the outputs: it gives the result, or writes it. Only the port that
/// `request` came through counts; the others may still hold an older request.
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
