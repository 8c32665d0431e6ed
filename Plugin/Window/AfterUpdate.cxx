// SPDX-License-Identifier: BSD-3-Clause
#include "AfterUpdate.h"

#include "PluginProxies.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqView.h>

#include <QPointer>
#include <QTimer>

namespace cactus
{

void afterUpdate(pqPVApplicationCore* core, QObject* owner, const std::function<void(pqPipelineSource*)>& act)
{
  QObject::connect(core->getServerManagerModel(), &pqServerManagerModel::dataUpdated, owner,
    [owner, act](pqPipelineSource* updated)
    {
      // The views get the data, and show them for the first time, only after this; the source may be gone by then.
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

void forEachShown(pqPipelineSource* source, const std::function<void(pqDataRepresentation*, pqOutputPort*, pqView*)>& act)
{
  for (pqOutputPort* port : source->getOutputPorts())
  {
    for (pqView* view : port->getViews())
    {
      for (pqDataRepresentation* shown : port->getRepresentations(view))
      {
        act(shown, port, view);
      }
    }
  }
}

} // namespace cactus
