// SPDX-License-Identifier: BSD-3-Clause
// Support for every filter that calls core: turns exceptions into VTK errors, and passes on progress and stop requests.
#pragma once

#include "base/Context.h"

#include <vtkType.h>

#include <functional>
#include <string>

class vtkAlgorithm;
class vtkDataObject;

namespace cactus
{

class Sharing;

/// Returns a context whose progress goes to `algorithm` and, at intervals, to standard error (see ProgressLog). It stops when the
/// user aborts the algorithm, or at a signal that ends the process. Throws InvalidInput as ProgressLog.
Context contextFor(vtkAlgorithm* algorithm, int threads = 0);

/// Runs `work`, and tells whether it completed. Any exception is reported once, as the algorithm's error; all outputs are then
/// empty and hold the message as field data `Error`, a string array. Errors that another rank reports are not repeated.
///
/// If an input holds that mark, directly or in a block, the fault has been reported: `work` is not run, nothing is reported, and
/// the outputs are marked likewise. The same holds if the pipeline repeats a request that has just failed. A run that the user
/// stopped is not started again by the next request, such as from a view that is drawn: a warning says so each time, until the
/// filter or its input is changed. A signal also stops `work`, and is passed on after it has ended (see StopSignals).
bool attempt(vtkAlgorithm* self, const std::function<void()>& work);

/// Does the same if all ranks share `work`. Collective: if `work` is not run in one rank, it is run in none.
bool attempt(vtkAlgorithm* self, const Sharing& sharing, const std::function<void()>& work);

/// Does the same for RequestData, and always returns 1. After a 0 ParaView's pipeline does not execute again for the next good
/// value, and a server and its client wait for each other. If a signal arrives while `work` still completes with a result, it
/// empties the outputs, too, so that later stages do not begin; filters that write files call attempt(), and keep them.
int guarded(vtkAlgorithm* self, const std::function<void()>& work);
int guarded(vtkAlgorithm* self, const Sharing& sharing, const std::function<void()>& work);

/// Reports that work was stopped before RequestData, which a signal may prevent; RequestData then does not repeat it.
void noteStopped(vtkAlgorithm* self, const std::string& message);

/// Runs `work` for RequestInformation and RequestUpdateExtent, which ignore its exceptions: RequestData fails in the same way,
/// and reports them.
void quietly(const std::function<void()>& work);

/// Returns the message that `data`, or one of its blocks, is marked with; empty if there is none.
std::string errorOf(vtkDataObject* data);

} // namespace cactus
