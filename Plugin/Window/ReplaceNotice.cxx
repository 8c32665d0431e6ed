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

/// Returns the substrate folder that a name from the dialog means; empty if there is none. One that is there already is entered
/// by the dialog, and gets its name once more.
QString folderMeant(const QString& name, pqServer* server)
{
  pqFileDialogModel files(server);
  const QFileInfo chosen(name);
  QString found;
  for (const QString& folder : { name, chosen.fileName() == QFileInfo(chosen.path()).fileName() ? chosen.path() : QString() })
  {
    if (!folder.isEmpty() && files.fileExists(folder + "/manifest.json", found))
    {
      return folder;
    }
  }
  return {};
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
  pqServer* server = pqApplicationCore::instance()->getServerManagerModel()->findServer(proxy->GetSession());
  const QString folder = folderMeant(vtkSMPropertyHelper(proxy, "FileName").GetAsString(), server);
  if (!folder.isEmpty())
  {
    auto* notice = new QLabel(QString("<b>%1 is there already. OK replaces it, unless its files were changed.</b>")
                                .arg(QFileInfo(folder).fileName().toHtmlEscaped()));
    notice->setObjectName("ReplaceNotice");
    notice->setWordWrap(true);
    widget->layout()->addWidget(notice);
  }
}

} // namespace cactus
