// SPDX-License-Identifier: BSD-3-Clause
#include "NarrowChoices.h"

#include "PluginProxies.h"

#include <pqPropertyWidget.h>
#include <vtkSMProxy.h>

#include <QAbstractItemView>
#include <QComboBox>

namespace cactus
{

NarrowChoices::NarrowChoices(QObject* parent)
  : QObject(parent)
{
}

void NarrowChoices::createDefaultWidgetDecorators(pqPropertyWidget* widget)
{
  if (!isOfThisPlugin(widget->proxy()))
  {
    return;
  }
  constexpr int letters = 8;
  for (QComboBox* choice : widget->findChildren<QComboBox*>())
  {
    const int widest = choice->sizeHint().width();
    choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    choice->setMinimumContentsLength(letters);
    choice->view()->setMinimumWidth(widest);
  }
}

} // namespace cactus
