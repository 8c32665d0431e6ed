// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

class QObject;
class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Calls act(source) each time after a source or filter of this plugin has been updated, once views have its data, as long as
/// `owner` lives.
void afterUpdate(pqPVApplicationCore* core, QObject* owner, const std::function<void(pqPipelineSource*)>& act);

} // namespace cactus
