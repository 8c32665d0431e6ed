// SPDX-License-Identifier: BSD-3-Clause
#include "ReplaceNotice.h"

#include <pqApplicationCore.h>
#include <pqFileDialogModel.h>
#include <pqPropertyWidget.h>
#include <pqServerManagerModel.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QFileInfo>
#include <QLabel>
#include <QLayout>

#include <cstring>

namespace cactus
{
namespace
{

/// Returns the folder that a name from the dialog means: one that is there already is entered, and gets its name once more.
QString folderMeant(const QString& name)
{
  const QFileInfo folder(name);
  return folder.fileName() == QFileInfo(folder.path()).fileName() ? folder.path() : name;
}

} // namespace

ReplaceNotice::ReplaceNotice(QObject* parent)
  : QObject(parent)
{
}

void ReplaceNotice::createDefaultWidgetDecorators(pqPropertyWidget* widget)
{
  vtkSMProxy* proxy = widget->proxy();
  if (widget->layout() == nullptr || widget->property() == nullptr || std::strcmp(proxy->GetXMLName(), "SubstrateFolder") != 0 ||
      std::strcmp(widget->property()->GetXMLName(), "Format") != 0)
  {
    return;
  }
  const QString folder = folderMeant(vtkSMPropertyHelper(proxy, "FileName").GetAsString());
  pqServer* server = pqApplicationCore::instance()->getServerManagerModel()->findServer(proxy->GetSession());
  QString found;
  if (pqFileDialogModel(server).dirExists(folder, found))
  {
    auto* notice =
      new QLabel(QString("<b>%1 is there already. OK replaces it.</b>").arg(QFileInfo(folder).fileName().toHtmlEscaped()));
    notice->setObjectName("ReplaceNotice");
    notice->setWordWrap(true);
    widget->layout()->addWidget(notice);
  }
}

} // namespace cactus
