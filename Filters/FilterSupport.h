// SPDX-License-Identifier: BSD-3-Clause
// What every filter needs around a call into core: exceptions turned into VTK's errors, progress and stopping passed on.
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

/// Context whose progress goes to `algorithm` and, now and then, to standard error (see ProgressLog), and which stops when the
/// user aborts it, or a signal comes that ends the process. Throws InvalidInput as ProgressLog.
Context contextFor(vtkAlgorithm* algorithm, int threads = 0);

/// Runs `work`, and tells whether it came to its end. Whatever it throws is reported once, as the algorithm's error; all outputs
/// are then empty and hold the message as field data `Error`, a string array. What another rank reports is not said again.
///
/// Where an input holds that mark, directly or in a block, the fault has been reported: `work` is not run, nothing is said, and
/// the outputs are marked likewise. The same holds where the pipeline asks again for what has just failed. What the user has
/// stopped is not started again by whatever asks next, such as a view that is drawn: a warning says so each time, until the
/// filter or its input is changed. A signal, too, stops `work`, and is passed on when that has ended (see StopSignals).
bool attempt(vtkAlgorithm* self, const std::function<void()>& work);

/// The same where all ranks share `work`, and all of them come here: where it is not run in one of them, it is in none.
bool attempt(vtkAlgorithm* self, const Sharing& sharing, const std::function<void()>& work);

/// The same for RequestData: always 1. After a 0 ParaView's pipeline does not execute again for the next good value, and a server
/// and its client wait for each other. A signal that has left `work` something to hand on, or came with its last moments, empties
/// the outputs as well, so that what follows does not begin; what writes files says attempt(), and keeps them.
int guarded(vtkAlgorithm* self, const std::function<void()>& work);
int guarded(vtkAlgorithm* self, const Sharing& sharing, const std::function<void()>& work);

/// For work that was stopped before RequestData, which a signal may not let come: says so, and RequestData then says it no more.
void noteStopped(vtkAlgorithm* self, const std::string& message);

/// The same as vtkAlgorithm::ComputePipelineMTime, but for a filter that was stopped: it counts as changed until it has run, so
/// that whatever asks for its output gets the warning. What follows in the pipeline would not ask again. Not of several ranks, of
/// which one would come to an exchange alone: these ask again after a change, or by Write.
int pipelineTime(vtkAlgorithm* self, vtkMTimeType* time);

/// Runs `work` for RequestInformation and RequestUpdateExtent, which say nothing of what it throws: RequestData fails in the same
/// way, and reports it.
void quietly(const std::function<void()>& work);

/// The message that `data`, or one of its blocks, is marked with; empty where there is none.
std::string errorOf(vtkDataObject* data);

} // namespace cactus
