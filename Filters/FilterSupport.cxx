// SPDX-License-Identifier: BSD-3-Clause
#include "FilterSupport.h"

#include "FilterProperties.h"
#include "InputBlocks.h"
#include "ProgressLog.h"
#include "Ranks.h"
#include "StopSignals.h"
#include "base/Error.h"
#include "base/Memory.h"
#include "base/Sharing.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationStringKey.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkSetGet.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>
#include <vtkTimeStamp.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <sstream>
#include <vector>

namespace cactus
{

namespace
{

constexpr const char* errorName = "Error"; ///< field data array with the error message

/// Key, in an algorithm's own information, of the record of a run that failed or was stopped.
vtkInformationStringKey* failedRunKey()
{
  static vtkInformationStringKey* const key = vtkInformationStringKey::MakeKey("FAILED_RUN", "cactus");
  return key;
}

vtkInformationStringKey* failureKey()
{
  static vtkInformationStringKey* const key = vtkInformationStringKey::MakeKey("FAILURE", "cactus");
  return key;
}

vtkInformationIntegerKey* stoppedKey()
{
  static vtkInformationIntegerKey* const key = vtkInformationIntegerKey::MakeKey("STOPPED", "cactus");
  return key;
}

/// Key of the time at which the stop was last reported, in seconds of a steady clock.
vtkInformationDoubleKey* saidKey()
{
  static vtkInformationDoubleKey* const key = vtkInformationDoubleKey::MakeKey("SAID", "cactus");
  return key;
}

/// Calls `visit` with each input data object.
template <typename Visit>
void forEachInput(vtkAlgorithm* self, Visit&& visit)
{
  for (int port = 0; port < self->GetNumberOfInputPorts(); ++port)
  {
    for (int connection = 0; connection < self->GetNumberOfInputConnections(port); ++connection)
    {
      if (vtkDataObject* data = self->GetInputDataObject(port, connection))
      {
        visit(data);
      }
    }
  }
}

/// Returns everything that a run depends on: two runs for which this is equal have the same result.
std::string runOf(vtkAlgorithm* self)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  std::ostringstream run;
  run << self->GetMTime();
  forEachInput(self, [&](vtkDataObject* data) { run << ' ' << changeTime(data); });
  vtkInformationVector* outputs = self->GetExecutive()->GetOutputInformation();
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    run << " | " << info->Get(Pipeline::UPDATE_PIECE_NUMBER()) << '/' << info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
    for (int i = 0; i < 6 && info->Has(Pipeline::UPDATE_EXTENT()) != 0; ++i)
    {
      run << ' ' << info->Get(Pipeline::UPDATE_EXTENT(), i);
    }
  }
  return run.str();
}

/// Empties all outputs and marks them with a message.
void leaveEmpty(vtkAlgorithm* self, const std::string& message)
{
  for (int port = 0; port < self->GetNumberOfOutputPorts(); ++port)
  {
    if (vtkDataObject* output = self->GetOutputDataObject(port))
    {
      output->Initialize();
      vtkNew<vtkStringArray> mark;
      mark->SetName(errorName);
      mark->InsertNextValue(message);
      output->GetFieldData()->AddArray(mark);
    }
  }
}

/// Records what happened for the next identical request.
void remember(vtkAlgorithm* self, const std::string& message, bool isStop)
{
  vtkInformation* info = self->GetInformation();
  info->Set(failedRunKey(), runOf(self).c_str());
  info->Set(failureKey(), message.c_str());
  info->Set(stoppedKey(), isStop ? 1 : 0);
}

void forget(vtkAlgorithm* self)
{
  vtkInformation* info = self->GetInformation();
  info->Remove(failedRunKey());
  info->Remove(failureKey());
  info->Remove(stoppedKey());
  info->Remove(saidKey());
}

void fail(vtkAlgorithm* self, const std::string& message)
{
  vtkErrorWithObjectMacro(self, << message);
  leaveEmpty(self, message);
  remember(self, message, false);
}

/// Reports that the run was stopped, once for requests at the same time: an update asks port after port, and some filters ask
/// ahead.
void sayStopped(vtkAlgorithm* self)
{
  vtkInformation* info = self->GetInformation();
  const double now = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  if (info->Has(saidKey()) == 0 || now - info->Get(saidKey()) > 1.0)
  {
    vtkWarningWithObjectMacro(self, << info->Get(failureKey()));
  }
  info->Set(saidKey(), now);
}

/// Returns why all outputs are already known to be empty; empty if unknown.
std::string knownFailure(vtkAlgorithm* self)
{
  std::string upstream;
  forEachInput(self, [&](vtkDataObject* data) { upstream = upstream.empty() ? errorOf(data) : upstream; });
  if (!upstream.empty())
  {
    return upstream;
  }
  vtkInformation* info = self->GetInformation();
  const bool isKnown = info->Has(failedRunKey()) != 0 && runOf(self) == info->Get(failedRunKey());
  return isKnown ? info->Get(failureKey()) : "";
}

/// Empties the outputs and returns true if this rank or another is already known to fail.
bool isKnownToFail(vtkAlgorithm* self, const Sharing& sharing)
{
  const std::string own = knownFailure(self);
  std::string known = own;
  sharing.together(
    [&]
    {
      for (const std::string& told : sharing.exchange(own))
      {
        known = known.empty() ? told : known;
      }
    });
  if (known.empty())
  {
    return false;
  }
  leaveEmpty(self, known);
  vtkInformation* info = self->GetInformation();
  if (info->Get(stoppedKey()) != 0 && own == info->Get(failureKey()))
  {
    sayStopped(self);
  }
  return true;
}

/// Returns the name in scripts: without VTK's prefix "vtk".
std::string nameOf(vtkAlgorithm* algorithm)
{
  return std::string(algorithm->GetClassName()).substr(3);
}

} // namespace

bool attempt(vtkAlgorithm* self, const Sharing& sharing, const std::function<void()>& work)
{
  if (isKnownToFail(self, sharing))
  {
    return false;
  }
  forget(self);
  // VTK reports progress before and after this, when the text of this run is wrong.
  const std::unique_ptr<vtkAlgorithm, void (*)(vtkAlgorithm*)> textless(
    self, [](vtkAlgorithm* done) { done->SetProgressText(nullptr); });
  setProcessesSharingMemory(processesOnThisMachine());
  const StopSignals signals;
  try
  {
    work();
    return true;
  }
  catch (const Cancelled& stop)
  {
    const std::string message = stop.what();
    leaveEmpty(self, message);
    remember(self, message, true);
    sayStopped(self);
  }
  catch (const ReportedElsewhere& error)
  {
    leaveEmpty(self, error.what());
    remember(self, error.what(), false);
  }
  catch (const Error& error)
  {
    fail(self, error.what());
  }
  catch (const std::bad_alloc&)
  {
    fail(self, "out of memory: choose a smaller Side or a larger VoxelSize");
  }
  catch (const std::filesystem::filesystem_error& error)
  {
    fail(self, error.what());
  }
  catch (const std::exception& error)
  {
    fail(self, std::string("this could not be worked out (") + error.what() +
                 "): look for a property or an input of an unusual size, and please report it with them");
  }
  catch (...)
  {
    fail(
      self, "this could not be worked out, for a reason that is not known: please report it with the properties and the input");
  }
  return false;
}

Context contextFor(vtkAlgorithm* algorithm, int threads)
{
  Context context;
  context.threads = threads;
  context.progress = [algorithm, log = std::make_shared<ProgressLog>(nameOf(algorithm))](
                       double fraction, const std::string& message)
  {
    algorithm->SetProgressText(message.c_str());
    algorithm->UpdateProgress(fraction);
    log->tell(fraction, message);
  };
  // The flag is cleared here and once it is noticed. VTK leaves it set, which would stop the next run at its start; if others
  // cleared it after this run, it would mark the filter as modified and make it run again.
  algorithm->SetAbortExecute(0);
  // Not CheckAbort(): once that has returned true, VTK empties every output, also a best result worth keeping.
  context.cancelled = [algorithm, stopped = std::make_shared<bool>(false)]
  {
    if (algorithm->GetAbortExecute() != 0 || StopSignals::areCaught())
    {
      *stopped = true;
      algorithm->SetAbortExecute(0);
    }
    return *stopped;
  };
  return context;
}

bool attempt(vtkAlgorithm* self, const std::function<void()>& work)
{
  return attempt(self, Sharing(), work);
}

void noteStopped(vtkAlgorithm* self, const std::string& message)
{
  remember(self, message, true);
  sayStopped(self);
}

int pipelineTime(vtkAlgorithm* self, vtkMTimeType* time)
{
  *time = self->GetMTime();
  if (processCount() == 1 && self->GetInformation()->Get(stoppedKey()) != 0)
  {
    vtkTimeStamp now;
    now.Modified();
    *time = now.GetMTime();
  }
  return 1;
}

int guarded(vtkAlgorithm* self, const std::function<void()>& work)
{
  return guarded(self, Sharing(), work);
}

int guarded(vtkAlgorithm* self, const Sharing& sharing, const std::function<void()>& work)
{
  attempt(self, sharing,
    [&]
    {
      work();
      if (StopSignals::areCaught())
      {
        throw Cancelled(); // so that later stages in the pipeline do not begin
      }
    });
  return 1;
}

void quietly(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (...)
  {
    return;
  }
}

std::string errorOf(vtkDataObject* data)
{
  std::vector<vtkDataObject*> places = leavesOf(data);
  places.push_back(data);
  for (vtkDataObject* place : places)
  {
    auto* mark = vtkStringArray::SafeDownCast(
      place != nullptr && place->GetFieldData() != nullptr ? place->GetFieldData()->GetAbstractArray(errorName) : nullptr);
    if (mark != nullptr && mark->GetNumberOfValues() > 0)
    {
      return mark->GetValue(0).empty() ? "an unknown error" : std::string(mark->GetValue(0));
    }
  }
  return "";
}

} // namespace cactus
