// SPDX-License-Identifier: BSD-3-Clause
#include "AfterUpdate.h"

#include "PluginProxies.h"

#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <QPointer>
#include <QTimer>

namespace cactus
{

void afterUpdate(pqPVApplicationCore* core, QObject* owner, const std::function<void(pqPipelineSource*)>& act)
{
  QObject::connect(core->getServerManagerModel(), &pqServerManagerModel::dataUpdated, owner,
    [owner, act](pqPipelineSource* updated)
    {
      // The views have the data, and show it for the first time, only after this; the source may be gone by then.
      QTimer::singleShot(0, owner,
        [act, source = QPointer<pqPipelineSource>(updated)]
        {
          if (source != nullptr && isOfThisPlugin(source->getProxy()))
          {
            act(source);
          }
        });
    });
}

} // namespace cactus
