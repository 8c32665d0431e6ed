// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

class QObject;
class pqDataRepresentation;
class pqOutputPort;
class pqPVApplicationCore;
class pqPipelineSource;
class pqView;

namespace cactus
{

/// Calls act(source) each time after a source or filter of this plugin has been updated and the views have its data, as long as
/// `owner` lives.
void afterUpdate(pqPVApplicationCore* core, QObject* owner, const std::function<void(pqPipelineSource*)>& act);

/// Calls act(representation, port, view) for all representations, visible or hidden, of a source or filter.
void forEachShown(pqPipelineSource* source, const std::function<void(pqDataRepresentation*, pqOutputPort*, pqView*)>& act);

} // namespace cactus
